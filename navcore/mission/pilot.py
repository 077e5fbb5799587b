"""Drives one plan: where on the route the robot is, on which source, and so which line is ahead."""

from __future__ import annotations

import math

from navcore.geometry.polyline import Projection
from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.row_line import RowLine
from navcore.messages import (
    MissionPlan,
    ModeSwitch,
    NavMode,
    NextTrunk,
    PathSegment,
    RowObservation,
    RowSource,
    SegmentKind,
)
from navcore.mission.evidence import RowEvidence
from navcore.mission.look_back import LeftRow, LookBack
from navcore.mission.map_evidence import MapEvidence
from navcore.mission.mode_facts import ModeFacts
from navcore.mission.mode_selector import ALONG_ROW, CARRIED, ON_CAMERA, ON_POSE, select_mode, start_reason
from navcore.mission.pilot_facts import mode_facts
from navcore.mission.pilot_params import PilotParams
from navcore.mission.position import Position
from navcore.mission.route import Leg, Place, Route
from navcore.mission.row_looks import Onlooker, RowLooks


class Pilot:
    """Follows one plan from its first leg to its last."""

    def __init__(
        self, plan: MissionPlan, start: Position, T_map_base: SE2, params: PilotParams, on_map: MapEvidence
    ) -> None:
        self.params = params
        self.on_map = on_map
        self.route = Route(plan)
        self.start_tie = T_map_base @ start.T_odom_base.inverse()
        self.anchor = PathAnchor(self.start_tie, params.anchor)
        self.looks = RowLooks(self.anchor, on_map, params)
        self.look_back = LookBack(self.anchor, params.row)
        self.carried = 0.0
        self.arrived = self.captured = False
        self.halt = ""
        self._comes_from_gnss = True
        self._at = start
        self.place = Place(0, 0.0)
        self.pose = self.leg.driving_pose(T_map_base)
        self.projection = self._project(near_s=None)
        self.mode, self.mode_reason = NavMode.GNSS_PATH, start_reason(start.gnss_std)

    @classmethod
    def of(cls, plan: MissionPlan | None, at: Position, params: PilotParams, on_map: MapEvidence) -> Pilot | None:
        """The pilot that drives a plan from here; None without a plan or a place on the map.

        Raises InputError for a plan that cannot be followed.
        """
        return None if plan is None or at.T_map_base is None else cls(plan, at, at.T_map_base, params, on_map)

    @property
    def leg(self) -> Leg:
        """The leg that is driven."""
        return self.route.legs[self.place.leg]

    @property
    def segment(self) -> PathSegment:
        """The planned segment here."""
        return self.leg.segment(self.place.s)

    @property
    def remaining(self) -> float:
        """Metres to the end of the leg, by the path."""
        return self.leg.length - self.place.s

    @property
    def gnss_good(self) -> bool:
        """GNSS could be driven on."""
        return self._at.gnss_good(self.params.mode)

    @property
    def row(self) -> RowEvidence:
        """The row that matters here, as it is seen."""
        return self.looks.evidence

    @property
    def sees_row(self) -> bool:
        """The row that matters here is seen in enough pictures to be trusted, and still is."""
        return self.looks.sees_row(self._at.now_ns)

    @property
    def by_scan(self) -> bool:
        """The line is that through scanned plants, and bends as they stand."""
        seen = self.row.agreeing
        return self.mode in ON_CAMERA and seen is not None and seen.source is not RowSource.CAMERA

    @property
    def before_seen_row(self) -> bool:
        """Between the turn on the headland and the entrance of the next row, which is seen."""
        return self.mode is NavMode.HEADLAND and self.segment.kind is SegmentKind.ENTRY and self.sees_row

    @property
    def wheel_way(self) -> float:
        """Metres along the mission, with those by which a row that goes on has put the robot back."""
        return self.route.driven(self.place) + self.anchor.put_back

    def advance(self, at: Position, row_seen: tuple[tuple[RowObservation, SE2], ...], dt: float) -> ModeSwitch | None:
        """Take one tick; the mode switch it brought. Observations come with `T_odom_base` at their capture."""
        driven = self._carry(at)
        for seen, T_odom_base in row_seen:
            self._see(seen, self.leg.driving_pose(T_odom_base))
        on_road, heading = self.mode in ON_POSE, self.leg.line.heading_at(self.place.s)
        if on_road and at.T_map_base is not None:
            self.anchor.follow_pose(at.T_map_base, at.T_odom_base, at.yaw_std)
        self.pose = self.anchor.slide(
            self.leg.driving_pose(at.T_odom_base), dt, driven, heading, self.projection.lateral, on_road
        )
        self.projection = self._project(self.place.s)
        self.captured = self.captured or abs(self.projection.lateral) <= self.params.capture
        self.place = Place(self.place.leg, self.projection.s)
        self._finish_leg(at)
        self._look_out()
        return self._choose_mode(at)

    def start_over(self) -> None:
        """The robot sets off from standstill: take the wanted tie at once, and let it get onto the path."""
        self.anchor.jump()
        self.captured = False
        self.halt = ""

    def _carry(self, at: Position) -> float:
        """Drive on by odometry; the distance, m."""
        moved = self._at.T_odom_base.inverse() @ at.T_odom_base
        distance = math.hypot(moved.x, moved.y)
        if at.standing:
            self.anchor.row.new_gyro()
        slope = -math.sin(at.roll) if self.leg.reverse else math.sin(at.roll)
        self.anchor.drive(distance, (at.now_ns - self._at.now_ns) * 1e-9, at.T_odom_base, slope)
        self.carried = self.carried + distance if self.mode in CARRIED else 0.0
        if self.mode not in ON_POSE:
            self._take_drift(self._at, at)
        self._at = at
        return distance

    def _take_drift(self, before: Position, now: Position) -> None:
        """Away from plants GNSS says by how much the wheels slip, though not where the row lies on the map."""
        ends = before.surely_at(self.params.drift_std), now.surely_at(self.params.drift_std)
        if ends[0] is None or ends[1] is None or self.mode not in CARRIED:
            self.anchor.slip_back(before.T_odom_base, now.T_odom_base)
            return
        moved = ends[1].x - ends[0].x, ends[1].y - ends[0].y
        self.anchor.drift(before.T_odom_base, now.T_odom_base, moved)

    def _see(self, seen: RowObservation, T_odom_drive: SE2) -> None:
        """Take what a camera saw of the row that is meant, or of the one that is left."""
        if seen.camera is not self.leg.camera:
            self.look_back.see(seen, T_odom_drive)
            return
        by = Onlooker(self.mode, self.leg, self.place.s, self._at, self._comes_from_gnss)
        if self.looks.take(seen, T_odom_drive, by):
            self.carried = 0.0

    def _project(self, near_s: float | None) -> Projection:
        return self.leg.line.project(self.pose.x, self.pose.y, near_s, self.params.search)

    def _finish_leg(self, at: Position) -> None:
        """Go on to the next leg once the robot stands at the end of this one."""
        if self.remaining > self.params.arrival or not at.standing:
            return
        if self.route.at_end(self.place):
            self.arrived = True
            return
        self.halt = self.leg.segments[-1].halt
        self.anchor.straighten(self.leg.driving_pose(at.T_odom_base))
        self.place = Place(self.place.leg + 1, 0.0)
        self.pose = self.anchor.followed @ self.leg.driving_pose(at.T_odom_base)
        self.projection = self._project(near_s=0.0)
        self.row.forget()
        self.looks.trunks.forget()
        self.look_back.row = LeftRow.of(self.row_segment())

    def _look_out(self) -> None:
        """Ahead, or back at the row that is being left once nothing is in sight ahead."""
        sees_ahead = self.sees_row and not self.looks.along.past_last_plants(self.row.agreeing)
        if self.look_back.choose(self.mode, self.segment, sees_ahead):
            self.row.forget()

    def _choose_mode(self, at: Position) -> ModeSwitch | None:
        before, facts = self.mode, self._facts(at)
        self.mode, reason = select_mode(before, facts, self.params.mode)
        if reason is None:
            return None
        self.mode_reason = reason
        if self.mode not in ON_CAMERA:
            self.anchor.straighten(self.leg.driving_pose(at.T_odom_base))
        self._on_switch()
        seen = self.row.agreeing
        return ModeSwitch(
            stamp_ns=at.now_ns, before=before, after=self.mode, reason=reason, x=self.pose.x, y=self.pose.y,
            along_segment=self.place.s, gnss_std=at.gnss_std, row_quality=seen.quality if seen else None,
            row_offset=seen.offset if seen else None, end_distance=facts.to_end,
        )  # fmt: skip

    def _on_switch(self) -> None:
        if self.mode not in ALONG_ROW:
            self.looks.trunks.forget()
        if self.mode is NavMode.ROW:
            self.look_back.row = LeftRow.of(self.row_segment())
        if self.mode in ON_POSE:
            self.anchor.leave()
            self._comes_from_gnss = True
        if self.mode is NavMode.HEADLAND:
            self.anchor.next_row()
            self.row.forget()
            self._comes_from_gnss = False

    def row_segment(self) -> PathSegment | None:
        """The segment whose row matters here: this one's, or the next entry's when it is near."""
        return self.leg.row_segment(self.place.s, self.params.look_out)

    def next_trunk(self) -> NextTrunk | None:
        """The known trunk that the robot comes to next in its row."""
        return self.looks.trunks.next_trunk(self.segment, self.pose) if self.mode in ALONG_ROW else None

    def row_line(self) -> RowLine | None:
        """Centre line of the row that matters here, as drawn."""
        return RowLine.of(self.row_segment())

    def to_start(self) -> float | None:
        """Metres ahead at which the row that matters here begins, negative inside; None where none matters."""
        row = self.row_line()
        return -row.coordinates(self.pose).x if row else None

    def _facts(self, at: Position) -> ModeFacts:
        to_start, look_out = self.to_start(), self.params.look_out
        return mode_facts(at, self.leg, self.place.s, self.row, self.on_map, look_out, to_start)
