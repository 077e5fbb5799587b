"""Looks at the row that is meant: each one is judged, and puts right where the path lies."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.row_filter import look_noise
from navcore.localization.row_line import RowLine
from navcore.messages import NavMode, PathSegment, RowObservation, RowSource
from navcore.mission.along_row import AlongRow
from navcore.mission.along_trunks import AlongTrunks
from navcore.mission.evidence import NO_IDEA, Doubt, RowEvidence
from navcore.mission.map_evidence import MapEvidence
from navcore.mission.mode_selector import ALONG_ROW, ON_CAMERA
from navcore.mission.pilot_params import PilotParams
from navcore.mission.position import Position
from navcore.mission.route import Leg, row_length


@dataclass(frozen=True, slots=True)
class Onlooker:
    """The robot at a look: what it drives on and where, `s` m along its leg.

    `comes_from_gnss`: no headland lies between here and where it last drove on GNSS.
    """

    mode: NavMode
    leg: Leg
    s: float
    at: Position
    comes_from_gnss: bool


class RowLooks:
    """Corrects the anchor by looks the way the leg is driven; `evidence` is what they are worth now."""

    def __init__(self, anchor: PathAnchor, on_map: MapEvidence, params: PilotParams) -> None:
        self._anchor, self._on_map, self._params = anchor, on_map, params
        self.evidence = RowEvidence(params.row)
        self.along = AlongRow(anchor, params.along)
        self.trunks = AlongTrunks(anchor, params.trunks)

    def sees_row(self, now_ns: int) -> bool:
        """The row is seen in enough pictures to be trusted, and still is."""
        mode, age_s = self._params.mode, self.evidence.age_s(now_ns)
        return self.evidence.streak >= mode.streak and age_s is not None and age_s <= mode.lost_s

    def take(self, seen: RowObservation, T_odom_drive: SE2, by: Onlooker) -> bool:
        """Judge a look by the row that is meant, `T_odom_drive` at its capture; True if it corrected the anchor."""
        segment = by.leg.row_segment(by.s, self._params.look_out)
        row = RowLine.of(segment)
        if row is None or segment is None or not self._judge(seen, row, segment.width, T_odom_drive, by):
            return False
        self._compare_map(seen, row, T_odom_drive, by)
        corrects = self._may_correct(row, T_odom_drive, by) and self._correct(seen, row, T_odom_drive)
        if by.mode in ALONG_ROW:
            self._place_along(seen, row, segment, T_odom_drive, at_end=by.mode is NavMode.ROW_END)
        return corrects

    def _judge(self, seen: RowObservation, row: RowLine, width: float, T_odom_drive: SE2, by: Onlooker) -> bool:
        doubt = Doubt(*self._anchor.departed_stds) if by.mode is NavMode.HEADLAND else NO_IDEA
        return self.evidence.judge(seen, row, self._expected(T_odom_drive, by), width, doubt)

    def _expected(self, T_odom_drive: SE2, by: Onlooker) -> tuple[SE2, ...]:
        """Poses of the driving frame at a capture: by the anchor, and before the entrance by what led there too.

        In a turn a fit may begin between two rows and creep over to the wrong one, taking the anchor with it.
        """
        at, by_anchor = by.at, self._anchor.T_map_odom @ T_odom_drive
        if by.mode is NavMode.HEADLAND:
            return by_anchor, self._anchor.departed @ T_odom_drive
        on_the_way_in = by.mode in (NavMode.GNSS_PATH, NavMode.ROW_ENTRY) and by.comes_from_gnss
        if at.T_map_base is None or not on_the_way_in or not at.gnss_good(self._params.mode):
            return (by_anchor,)
        return by_anchor, at.T_map_base @ at.T_odom_base.inverse() @ T_odom_drive

    def _compare_map(self, seen: RowObservation, row: RowLine, T_odom_drive: SE2, by: Onlooker) -> None:
        """What the row says of the place on the 3D map, and the map of the row as drawn."""
        at, way = by.at, by.leg.row_way(by.s, self._params.look_out)
        if by.mode is NavMode.ROW and at.T_map_base is not None and way is not None:
            self._on_map.add_row(way, seen, row, T_odom_drive, at.T_map_base @ at.T_odom_base.inverse())

    def _may_correct(self, row: RowLine, T_odom_drive: SE2, by: Onlooker) -> bool:
        turned_to = by.mode is NavMode.HEADLAND and self._turned_to_row(row, T_odom_drive, by.at.now_ns)
        return by.mode in ON_CAMERA or turned_to

    def _turned_to_row(self, row: RowLine, T_odom_drive: SE2, now_ns: int) -> bool:
        """Before the next row and turned to it: seen so, it puts right what the wheels got wrong in the turn."""
        at = row.coordinates(self._anchor.T_map_odom @ T_odom_drive)
        return self.sees_row(now_ns) and at.x < 0.0 and abs(at.yaw) <= self._params.turned_to

    def _correct(self, seen: RowObservation, row: RowLine, T_odom_drive: SE2) -> bool:
        """Lay the drawn row onto the seen one; False if the look tells no line."""
        if seen.offset is None or seen.heading is None:
            return False
        noise = look_noise(seen.offset_std or 0.05, seen.heading_std or 0.02, seen.correlation)
        if seen.source is not RowSource.CAMERA:
            noise = noise * self._params.scanned_share
        self._anchor.see_row(row, T_odom_drive, seen.offset, seen.heading, noise, seen.curvature)
        return True

    def _place_along(
        self, seen: RowObservation, row: RowLine, segment: PathSegment, T_odom_drive: SE2, *, at_end: bool
    ) -> None:
        self.along.see(seen, row, T_odom_drive, row_length(segment), at_end=at_end)
        self.trunks.see(seen, segment, T_odom_drive)
