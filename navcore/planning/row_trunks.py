"""The trunks of a row that is visited, and the one beside which the robot stops."""

from __future__ import annotations

import math
from collections.abc import Iterator

from navcore.maps.mission import Mission, RowExit, RowVisit
from navcore.maps.site_map import Row, SiteMap
from navcore.maps.trunk_map import RowTrunk, TrunkMap, trunks_of_row
from navcore.messages import PlannedTrunk
from navcore.planning.driven_row import DrivenRow
from navcore.planning.params import PlanningParams

# Between the entry and a stop the robot drives at least so far in the row, m: it needs to see the row first.
_LEAST_IN_ROW = 1.0


def planned_trunks(trunks: TrunkMap, row: DrivenRow) -> tuple[PlannedTrunk, ...]:
    """Those on the row's lines, in the direction in which it is driven and in that order."""
    sense = 1 if row.from_start else -1
    begin = 0.0 if row.from_start else row.length
    found = [
        PlannedTrunk(
            id=t.trunk.id, side=sense * t.side, line=t.side, number=t.number, of=t.of,
            along=round(begin + sense * t.along, 4), lateral=round(sense * t.lateral, 4), std=t.trunk.std,
        )
        for t in trunks_of_row(trunks, row.row)
    ]  # fmt: skip
    return tuple(sorted(found, key=lambda trunk: (trunk.along, trunk.side)))


def stop_of(trunks: TrunkMap, row: DrivenRow, visit: RowVisit) -> tuple[float, str] | None:
    """How far past the entrance the robot stops, m, and what it then says; None: it drives the whole row."""
    target = _target(trunks, row.row, visit)
    if target is None:
        return None
    along = target.along if row.from_start else row.length - target.along
    return along, f"At row {row.row.name or row.row.id}, {target.name}. Resume to go on."


def stop_problems(site: SiteMap, mission: Mission, trunks: TrunkMap, params: PlanningParams) -> Iterator[str]:
    """Why the stops at trunks cannot be driven."""
    rows = {row.id: row for row in site.rows}
    for number, visit in enumerate(mission.visits, start=1):
        if visit.stop_at is not None and visit.row_id in rows:
            yield from _stop_problems(trunks, rows[visit.row_id], visit, f"Visit {number}", params)
            if _entered_by_turn(mission, number - 1):
                yield (
                    f"Visit {number} stops at a trunk, but its row is entered by a turn on the headland. Let the row "
                    "before it end in reverse or through."
                )


def _entered_by_turn(mission: Mission, index: int) -> bool:
    return index > 0 and mission.visits[index - 1].exit is RowExit.NEXT_ROW


def _stop_problems(trunks: TrunkMap, row: Row, visit: RowVisit, name: str, params: PlanningParams) -> Iterator[str]:
    where = f"row {row.name or row.id}"
    if visit.exit is not RowExit.REVERSE:
        yield f"{name} stops at a trunk of {where}: it can only leave in reverse. Choose reverse as its exit."
    if all(trunk.id != visit.stop_at for trunk in trunks.trunks):
        yield f"{name} stops at trunk {visit.stop_at}, which the trunk map does not have. Choose another trunk."
        return
    target = _target(trunks, row, visit)
    if target is None:
        yield f"{name} stops at trunk {visit.stop_at}, which is not of {where}. Choose one that is."
        return
    yield from _room_problems(row, visit, target, f"{name} stops at {where}, {target.name}", params)


def _room_problems(row: Row, visit: RowVisit, target: RowTrunk, what: str, params: PlanningParams) -> Iterator[str]:
    length = math.dist(row.start, row.end)
    along = target.along if visit.from_start else length - target.along
    nearest, furthest = params.entry_inside + _LEAST_IN_ROW, length - params.reverse_stop
    if along < nearest:
        yield (
            f"{what}, {along:.1f} m past the end at which the row is entered; {nearest:.1f} m are needed. Enter "
            "it at the other end, or choose a trunk further in."
        )
    elif along > furthest:
        yield (
            f"{what}, {length - along:.1f} m before the row's far end; {params.reverse_stop:.1f} m are needed. Enter "
            "it at the other end, or choose a trunk before it."
        )


def _target(trunks: TrunkMap, row: Row, visit: RowVisit) -> RowTrunk | None:
    return next((t for t in trunks_of_row(trunks, row) if t.trunk.id == visit.stop_at), None)
