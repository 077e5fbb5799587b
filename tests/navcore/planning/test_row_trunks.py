"""Trunks on a plan, and stops beside one of them."""

from __future__ import annotations

from dataclasses import replace

import pytest

from navcore.errors import MissionError
from navcore.maps.mission import Mission, RowExit, RowVisit
from navcore.maps.trunk_map import MappedTrunk, TrunkMap
from navcore.messages import MissionPlan, SegmentKind
from navcore.planning.mission_planner import plan_mission
from navcore.vehicle import PAPER_A
from tests.missions.conftest import small_farm

SITE = small_farm()
ROW = SITE.rows[1]
HALF = ROW.width / 2
TRUNKS = TrunkMap(
    trunks=tuple(
        MappedTrunk(id=f"{name}{k}", x=ROW.start[0] + side * HALF, y=first + k, std=0.03, diameter=0.1)
        for name, side, first in (("left", -1.0, 1.0), ("right", 1.0, 0.5))
        for k in range(24)
    )
)


def plan(stop_at: str | None, *, from_start: bool = True, row_exit: RowExit = RowExit.REVERSE) -> MissionPlan:
    visit = RowVisit(row_id=ROW.id, from_start=from_start, exit=row_exit, stop_at=stop_at)
    mission = Mission(id="m", name="To a trunk", outbound=(), visits=(visit,), inbound=())
    return plan_mission(SITE, mission, PAPER_A, trunks=TRUNKS)


def test_robot_drives_in_as_far_as_the_trunk_and_waits_there() -> None:
    segments = plan("left9").segments
    into = next(s for s in segments if s.kind is SegmentKind.ROW and not s.reverse)
    assert into.points[-1] == pytest.approx((ROW.start[0], 10.0), abs=1e-3)  # m
    assert into.halt == "At row Row 2, left trunk 10 of 24. Resume to go on."
    back = next(s for s in segments if s.kind is SegmentKind.ROW and s.reverse)
    assert back.points[0] == into.points[-1]
    assert all(not s.halt for s in segments if s is not into)


def test_row_segments_carry_their_trunks_in_their_own_direction() -> None:
    into, back = (s for s in plan(None).segments if s.kind is SegmentKind.ROW)
    first, last = into.trunks[0], back.trunks[-1]
    assert (first.along, first.side, first.number, first.of) == (0.5, -1, 1, 24)
    assert (last.along, last.number) == (24.5, 1)
    by_id = {t.id: t for t in back.trunks}
    assert all(by_id[t.id].side == -t.side and by_id[t.id].line == t.line for t in into.trunks)
    assert [t.along for t in back.trunks] == sorted(t.along for t in back.trunks)


def test_a_plan_without_a_trunk_map_is_the_plan_of_before() -> None:
    visit = RowVisit(row_id=ROW.id)
    mission = Mission(id="m", name="", outbound=(), visits=(visit,), inbound=())
    bare, known = (plan_mission(SITE, mission, PAPER_A, trunks=t) for t in (TrunkMap(), TRUNKS))
    assert all(s.trunks == () for s in bare.segments)
    assert tuple(replace(s, trunks=()) for s in known.segments) == bare.segments


@pytest.mark.parametrize(
    ("stop_at", "from_start", "row_exit", "words"),
    [
        ("left9", True, RowExit.THROUGH, "can only leave in reverse"),
        ("nobody", True, RowExit.REVERSE, "which the trunk map does not have"),
        ("left0", True, RowExit.REVERSE, "past the end at which the row is entered"),
        ("right0", False, RowExit.REVERSE, "before the row's far end"),
    ],
)
def test_a_stop_that_cannot_be_driven_is_refused(
    stop_at: str, from_start: bool, row_exit: RowExit, words: str
) -> None:
    with pytest.raises(MissionError, match=words):
        plan(stop_at, from_start=from_start, row_exit=row_exit)


def test_a_trunk_of_another_row_is_refused() -> None:
    visit = RowVisit(row_id="r3", stop_at="left9")
    mission = Mission(id="m", name="", outbound=(), visits=(visit,), inbound=())
    with pytest.raises(MissionError, match="which is not of row Row 4"):
        plan_mission(SITE, mission, PAPER_A, trunks=TRUNKS)
