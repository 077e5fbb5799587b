"""From a mission on the site map to the path that is driven and shown: warehouse, road, rows, road, warehouse."""

from __future__ import annotations

import math

import numpy as np

from navcore.errors import MissionError
from navcore.geometry.se2 import SE2
from navcore.maps.mission import Mission, RowExit, RowVisit, Waypoint
from navcore.maps.site_map import SiteMap, ZoneKind
from navcore.maps.trunk_map import TrunkMap
from navcore.messages import MissionPlan, SegmentKind
from navcore.planning.connection import Option
from navcore.planning.departures import Departure, backwards_out, from_parking, through_the_end
from navcore.planning.draft import Draft
from navcore.planning.driven_row import DrivenRow
from navcore.planning.free_space import FreeSpace
from navcore.planning.headland_turns import headland_turn
from navcore.planning.input_checks import input_problems
from navcore.planning.params import PlanningParams
from navcore.planning.road import Road, add_road
from navcore.planning.row_entry import entry_options
from navcore.planning.row_mission import mission_for_row, way_between
from navcore.planning.row_trunks import planned_trunks, stop_of, stop_problems
from navcore.vehicle import VehicleParams

__all__ = ["draft_mission", "mission_for_row", "plan_mission"]

# Parking in another direction than the warehouse's is worse than this much more way, m.
_PARKED_ASKEW = 25.0


def plan_mission(
    site: SiteMap, mission: Mission, vehicle: VehicleParams, params: PlanningParams = PlanningParams(),
    trunks: TrunkMap = TrunkMap(),
) -> MissionPlan:  # fmt: skip
    """The path of a mission. Raises MissionError with every reason why it cannot be driven."""
    plan, problems = draft_mission(site, mission, vehicle, params, trunks)
    if plan is None or problems:
        raise MissionError(problems)
    return plan


def draft_mission(
    site: SiteMap, mission: Mission, vehicle: VehicleParams, params: PlanningParams = PlanningParams(),
    trunks: TrunkMap = TrunkMap(),
) -> tuple[MissionPlan | None, tuple[str, ...]]:  # fmt: skip
    """The path as far as it can be drawn, and every reason why it must not be driven."""
    problems = input_problems(site, mission, vehicle, params)
    problems += tuple(stop_problems(site, mission, trunks, params))
    if problems:
        return None, problems
    planner = _Planner(site, mission, vehicle, params, trunks)
    planner.run()
    return planner.plan(), tuple(dict.fromkeys(planner.draft.problems))


class _Planner:
    """Walks through the mission once and drafts its path."""

    def __init__(
        self, site: SiteMap, mission: Mission, vehicle: VehicleParams, params: PlanningParams, trunks: TrunkMap
    ) -> None:
        self._site, self._mission, self._params, self._trunks = site, mission, params, trunks
        self._space = FreeSpace(site, vehicle, params)
        self.draft = Draft(self._space, vehicle, params)
        self._number = 1

    def plan(self) -> MissionPlan:
        """What has been drafted."""
        site, datum = self._site, self._site.datum
        polygons = {kind: tuple(z.polygon for z in site.zones if z.kind is kind) for kind in ZoneKind}
        return MissionPlan(
            mission_id=self._mission.id, name=self._mission.name,
            datum=(datum.lat_deg, datum.lon_deg, datum.height_m), segments=self.draft.finished(),
            keep_in=polygons[ZoneKind.KEEP_IN], keep_out=polygons[ZoneKind.KEEP_OUT],
        )  # fmt: skip

    def run(self) -> None:
        """From the warehouse through all rows and back."""
        home = self._home()
        self._check_home(home)
        departures, place = from_parking(home, self._space, self._params), "from the warehouse"
        waypoints, entered = self._mission.outbound, None
        for index, visit in enumerate(self._mission.visits):
            row = entered or DrivenRow(self._site.row(visit.row_id), visit.from_start)
            if entered is None:
                self._enter(departures, place, waypoints, row, visit)
            departures, entered, waypoints = self._drive(index, row, visit)
            place = f"from row {_name(row)}"
        if self._mission.visits:
            waypoints = self._mission.inbound
        else:
            waypoints = (*self._mission.outbound, *self._mission.inbound)
        add_road(
            self.draft,
            departures,
            self._road(f"{place} to the warehouse", waypoints),
            self._parking(home),
            self._params,
        )

    def _home(self) -> SE2:
        house = self._site.warehouse
        assert house is not None  # input_problems has made sure
        return SE2(house.x, house.y, house.yaw)

    def _check_home(self, home: SE2) -> None:
        hit = self._space.blocked(np.array([(home.x, home.y, home.yaw)]))
        if hit is not None:
            self.draft.problems.append(
                f"At the warehouse ({home.x:.1f}, {home.y:.1f}) m the robot has no room to park: it meets {hit[1]}. "
                "Move the warehouse or what is there."
            )

    def _parking(self, home: SE2) -> list[Option]:
        """The warehouse's own pose, at a price any other direction."""
        turns = [k * math.pi / 4 for k in (1, -1, 2, -2, 3, -3, 4)]
        askew = [Option(home @ SE2(0.0, 0.0, turn), _PARKED_ASKEW, 0.0) for turn in turns]
        return [Option(home, 0.0, 0.0), *askew]

    def _road(self, name: str, waypoints: tuple[Waypoint, ...]) -> Road:
        road = Road(name, waypoints, self._number)
        self._number += len(waypoints)
        return road

    def _enter(
        self,
        departures: list[Departure],
        place: str,
        waypoints: tuple[Waypoint, ...],
        row: DrivenRow,
        visit: RowVisit,
    ) -> None:
        road = self._road(f"{place} to row {_name(row)}", waypoints)
        goal = add_road(self.draft, departures, road, entry_options(row, self._params), self._params)
        self._add_entry(row, goal.key, visit.speed)

    def _add_entry(self, row: DrivenRow, length: float, speed: float) -> None:
        p = self._params
        inside = min(p.entry_inside, row.length / 2)
        poses = row.line(-length, inside, p.step)
        self.draft.check(poses, f"entering row {_name(row)}")
        self.draft.add(SegmentKind.ENTRY, poses, min(speed, p.turn_speed), row=row)

    def _drive(
        self, index: int, row: DrivenRow, visit: RowVisit
    ) -> tuple[list[Departure], DrivenRow | None, tuple[Waypoint, ...]]:
        """Drive the row and get out: ways to go on, or the next row if the headland turn has led into it already."""
        following = self._mission.visits[index + 1] if index + 1 < len(self._mission.visits) else None
        if visit.exit is RowExit.REVERSE:
            departures = self._drive_in_and_back(row, visit)
        else:
            self._drive_row(row, row.length - min(self._params.exit_inside, row.length / 2), visit.speed)
            if visit.exit is RowExit.NEXT_ROW and following is not None:
                return [], self._change(row, following), ()
            departures = through_the_end(row, self._params)
            self.draft.check(departures[0].parts[0].poses, f"leaving row {_name(row)}")
        return departures, None, self._between(departures, following)

    def _drive_row(self, row: DrivenRow, until: float, speed: float, halt: str = "") -> None:
        poses = row.line(min(self._params.entry_inside, row.length / 2), until, self._params.step)
        self.draft.check(poses, f"in row {_name(row)}")
        trunks = planned_trunks(self._trunks, row)
        self.draft.add(SegmentKind.ROW, poses, speed, row=row, trunks=trunks, halt=halt)

    def _drive_in_and_back(self, row: DrivenRow, visit: RowVisit) -> list[Departure]:
        p = self._params
        turn, halt = stop_of(self._trunks, row, visit) or (row.length - p.reverse_stop, "")
        self._drive_row(row, turn, visit.speed, halt)
        back = row.reversed()
        poses = back.line(back.length - turn, back.length - min(p.exit_inside, back.length / 2), p.step)
        trunks = planned_trunks(self._trunks, back)
        self.draft.add(SegmentKind.ROW, poses, visit.speed, reverse=True, row=back, trunks=trunks)
        departures = backwards_out(row, self._space, p)
        self.draft.check(departures[0].parts[0].poses, f"leaving row {_name(row)} in reverse")
        return departures

    def _change(self, row: DrivenRow, following: RowVisit) -> DrivenRow:
        """Headland turn into the next visit's row, entered at the end that is nearer."""
        p, target = self._params, self._site.row(following.row_id)
        near_start = math.dist(row.far_end, target.start) <= math.dist(row.far_end, target.end)
        entered = DrivenRow(target, near_start)
        turn = headland_turn(row, entered, lambda poses: self._space.blocked_turn(poses, row.far_end), p)
        if turn.obstacle:
            self.draft.problems.append(self._no_turn(row, entered, turn.obstacle))
        inside = row.length - min(p.exit_inside, row.length / 2)
        leaving = row.line(inside, row.length + turn.exit_length, p.step)
        self.draft.check(leaving, f"leaving row {_name(row)}")
        self.draft.add(SegmentKind.EXIT, leaving, min(p.turn_speed, following.speed), row=row)
        for poses, reverse in turn.parts:
            self.draft.add(SegmentKind.HEADLAND, poses, p.turn_speed, reverse=reverse)
        self._add_entry(entered, turn.entry_length, following.speed)
        return entered

    def _no_turn(self, row: DrivenRow, entered: DrivenRow, obstacle: str) -> str:
        depth = self._space.depth_beyond(row.pose(row.length))
        return (
            f"From row {_name(row)} to row {_name(entered)} no turn fits: even with a radius of "
            f"{min(self._params.radii):g} m and in reverse it meets {obstacle}. The headland leaves {depth:.1f} m "
            "beyond the row's end; make it deeper, choose another row or drive back out in reverse."
        )

    def _between(self, departures: list[Departure], following: RowVisit | None) -> tuple[Waypoint, ...]:
        """Waypoints over the lanes to the next visit's row."""
        if following is None:
            return ()
        goal = DrivenRow(self._site.row(following.row_id), following.from_start)
        start = departures[0].pose
        return way_between(self._site, (start.x, start.y), goal, self._params)


def _name(row: DrivenRow) -> str:
    return row.row.name or row.row.id
