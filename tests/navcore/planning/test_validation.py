"""Every reason at once, each a sentence that names the place."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from navcore.errors import MissionError
from navcore.maps.mission import Mission, RowExit, RowVisit, Waypoint
from navcore.maps.site_map import SiteMap, Warehouse, Zone, ZoneKind
from navcore.planning.mission_planner import mission_for_row, plan_mission
from navcore.planning.validation import find_problems
from navcore.vehicle import PAPER_A
from tests.navcore.planning.farms import farm, zone


def problems(site: SiteMap, mission: Mission | None = None) -> tuple[str, ...]:
    return find_problems(site, mission or mission_for_row(site, "R2", RowExit.REVERSE), PAPER_A)


def test_a_good_mission_has_none() -> None:
    assert problems(farm(headland=6.0)) == ()


def test_a_thin_keep_out_zone_between_two_waypoints_is_found() -> None:
    wall = zone(ZoneKind.KEEP_OUT, -12.0, -8.0, -11.98, 0.0, name="wall")
    found = problems(farm(zones=(wall,)))
    assert any("the keep-out zone wall at" in reason and "waypoint" in reason for reason in found)


def test_the_body_counts_not_the_line() -> None:
    beside = zone(ZoneKind.KEEP_OUT, -18.0, -5.2, -8.0, -5.0 + 0.6)
    site = farm()
    straight = Mission(id="m", name="m", outbound=(Waypoint(x=-20, y=-6), Waypoint(x=0, y=-6)), visits=(), inbound=())
    assert not problems(site, straight)
    touching = replace(
        site, zones=(replace(beside, polygon=((-18.0, -5.4), (-8.0, -5.4), (-8.0, -4.0), (-18.0, -4.0))),)
    )
    free = replace(site, zones=(replace(beside, polygon=((-18.0, -5.2), (-8.0, -5.2), (-8.0, -4.0), (-18.0, -4.0))),))
    assert problems(touching, straight)
    assert not problems(free, straight)


def test_leaving_the_keep_in_zone_is_found() -> None:
    found = problems(farm(zones=(zone(ZoneKind.KEEP_IN, -40, -25, 40, 50),)))
    assert any("edge of the keep-in zone" in reason and "row R2" in reason for reason in found)


def test_a_headland_too_shallow_for_any_turn_is_found_with_its_depth() -> None:
    site = farm(headland=6.0)
    shallow = replace(site, zones=(zone(ZoneKind.HEADLAND, -5, 60, 20, 62),))
    found = problems(shallow, mission_for_row(shallow, "R2", RowExit.NEXT_ROW))
    assert any("no turn fits" in reason and "headland" in reason for reason in found)


def test_everything_wrong_is_listed_at_once() -> None:
    crossed = Zone(id="z", kind=ZoneKind.KEEP_OUT, polygon=((50, 0), (60, 10), (60, 0), (50, 10)))
    nan = Zone(id="n", kind=ZoneKind.KEEP_OUT, polygon=((50, 0), (math.nan, 10), (60, 0)))
    site = replace(farm(width=1.0, zones=(crossed, nan)), warehouse=Warehouse(x=math.inf, y=0.0, yaw=0.0))
    mission = Mission(
        id="m", name="m", outbound=(Waypoint(x=math.nan, y=0.0, speed=-1.0),),
        visits=(RowVisit(row_id="R1", speed=9.0), RowVisit(row_id="none", exit=RowExit.NEXT_ROW)), inbound=(),
    )  # fmt: skip
    found = problems(site, mission)
    for words in (
        "warehouse's position", "crosses itself", "three corners that are numbers", "outbound waypoint 1 is not",
        "to outbound waypoint 1 is -1", "in row R1 is 9", "names row none", "no next row", "R1 is 1.00 m wide",
    ):  # fmt: skip
        assert any(words in reason for reason in found), words
    assert all(reason[0].isupper() and reason.endswith(".") for reason in found)
    with pytest.raises(MissionError) as caught:
        plan_mission(site, mission, PAPER_A)
    assert caught.value.reasons == found


def test_a_way_that_no_battery_lasts_for_is_refused_before_it_is_drawn() -> None:
    far = Mission(id="m", name="m", outbound=(Waypoint(x=20_000.0, y=0.0),), visits=(), inbound=())
    assert problems(farm(), far) == ("The mission is 40 km long; 30 km are possible. Split it.",)
    again = replace(mission_for_row(farm(), "R2", RowExit.REVERSE), visits=(RowVisit(row_id="R2"),) * 600)
    assert len(problems(farm(), again)) == 1


def test_a_hairpin_between_waypoints_is_too_sharp() -> None:
    mission = Mission(
        id="m", name="m", visits=(), inbound=(),
        outbound=(Waypoint(x=-20, y=-6), Waypoint(x=-5, y=-6), Waypoint(x=-20, y=-6.2)),
    )  # fmt: skip
    assert any("waypoint 2" in reason and "too sharp" in reason for reason in problems(farm(), mission))


def test_an_empty_mission_and_a_site_without_warehouse_are_refused() -> None:
    empty = Mission(id="m", name="m", outbound=(), visits=(), inbound=())
    found = problems(replace(farm(), warehouse=None), empty)
    assert len(found) == 2


def test_a_warehouse_in_a_keep_out_zone_is_named_first() -> None:
    found = problems(farm(zones=(zone(ZoneKind.KEEP_OUT, -30, -18, -24, -12),)))
    assert found[0].startswith("At the warehouse (-27.0, -15.0) m the robot has no room to park: it meets a keep-out")
    assert len(found) == len({reason.replace(",", "") for reason in found})


def test_very_many_sharp_turns_are_named_in_one_sentence() -> None:
    zigzag = tuple(Waypoint(x=-20 + 0.1 * n, y=-8 + 0.4 * (n % 2)) for n in range(120))
    found = problems(farm(), Mission(id="m", name="m", outbound=zigzag, visits=(), inbound=()))
    assert len(found) < 12
    assert any("more turns on the way" in reason and "leave most of them out" in reason for reason in found)


def test_rows_that_cross_are_to_be_corrected() -> None:
    site = farm()
    across = replace(site.rows[0], id="X", start=(-5.0, 20.0), end=(20.0, 40.0))
    (found,) = problems(replace(site, rows=(*site.rows, across)))
    assert found.startswith("In row R2 the robot comes nearer than 0.2 m to a line of plants")
    assert found.endswith("Move the path, or correct the rows.")
