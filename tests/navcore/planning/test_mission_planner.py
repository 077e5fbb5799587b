"""Warehouse -> road -> row -> road -> warehouse, as a path that a robot can drive."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
import shapely

from navcore.errors import MissionError
from navcore.geometry.polyline import Polyline
from navcore.maps.geojson import import_site
from navcore.maps.mission import Mission, RowExit, RowVisit, Waypoint
from navcore.maps.site_map import Row, SiteMap, Warehouse, ZoneKind
from navcore.messages import MissionPlan, PathSegment, SegmentKind
from navcore.planning.mission_planner import mission_for_row, plan_mission
from navcore.planning.params import PlanningParams
from navcore.planning.preview import preview
from navcore.planning.speeds import planned_speeds
from navcore.vehicle import PAPER_A
from tests.navcore.planning.farms import farm, zone

K = SegmentKind


def legs(plan: MissionPlan) -> list[tuple[Polyline, bool]]:
    """Stretches driven one way, as the navigator joins them."""
    joined: list[tuple[list[tuple[float, float]], bool]] = []
    for segment in plan.segments:
        if not joined or joined[-1][1] is not segment.reverse:
            joined.append(([], segment.reverse))
        joined[-1][0].extend(segment.points)
    return [(Polyline(np.array(points)), reverse) for points, reverse in joined]


def assert_drivable(plan: MissionPlan, radius: float = 0.55) -> None:
    """Joined up, dense, bounded in curvature, changing direction only where the robot stops."""
    for a, b in pairwise(plan.segments):
        assert math.dist(a.points[-1], b.points[0]) < 0.01
    for line, _ in legs(plan):
        assert np.diff(line.s).max() < 0.15
        bends = np.abs(np.diff(np.unwrap(line.headings)))
        assert bends.max() < 0.1 / radius * 1.3
    for (before, was), (after, now) in pairwise(legs(plan)):
        assert was is not now
        turn = abs(math.remainder(before.headings[-1] - after.headings[0], 2 * math.pi))
        assert turn > math.radians(170.0)
    for segment in plan.segments:
        assert len(segment.points) == len(segment.speeds) >= 2
        assert 0.0 < min(segment.speeds) <= max(segment.speeds) <= PAPER_A.max_speed


def swept(segments: tuple[PathSegment, ...], margin: float = 0.0) -> shapely.Geometry:
    """Ground under the body along the path: what any part of it covers."""
    bodies = []
    a, b = PAPER_A.length / 2 + margin, PAPER_A.width / 2 + margin
    for segment in segments:
        line = Polyline(np.array(segment.points))
        for s in np.arange(0.0, line.length, 0.3):
            (x, y), h = line.at(float(s)), line.heading_at(float(s))
            c, n = math.cos(h), math.sin(h)
            corners = [(x + c * u - n * w, y + n * u + c * w) for u, w in ((a, b), (-a, b), (-a, -b), (a, -b))]
            bodies.append(shapely.Polygon(corners))
    return shapely.union_all(bodies)


@pytest.mark.parametrize("row_exit", list(RowExit))
@pytest.mark.parametrize("row", ["R0", "R2", "R5"])
def test_one_click_on_a_row_makes_a_drivable_mission(row: str, row_exit: RowExit) -> None:
    site = farm(headland=6.0, zones=(zone(ZoneKind.KEEP_IN, -40, -25, 40, 70),))
    plan = plan_mission(site, mission_for_row(site, row, row_exit), PAPER_A)
    assert_drivable(plan)
    house = site.warehouse
    assert house is not None
    assert plan.segments[0].points[0] == pytest.approx((house.x, house.y))
    assert plan.segments[-1].points[-1] == pytest.approx((house.x, house.y), abs=0.01)
    assert swept(plan.segments, 0.25).within(shapely.box(-40, -25, 40, 70))
    plants = shapely.MultiLineString([((x - 1.25, 0), (x - 1.25, 60)) for x in np.arange(0.0, 17.6, 2.5)])
    assert swept(plan.segments, 0.1).disjoint(plants)


def test_the_row_is_entered_straight_and_driven_on_its_axis() -> None:
    site = farm()
    plan = plan_mission(site, mission_for_row(site, "R3", RowExit.THROUGH), PAPER_A)
    kinds = [segment.kind for segment in plan.segments]
    i = kinds.index(K.ENTRY)
    assert kinds[i : i + 3] == [K.ENTRY, K.ROW, K.EXIT]
    entry, row, out = plan.segments[i : i + 3]
    assert {p[0] for s in (entry, row, out) for p in s.points} == {7.5}
    assert entry.points[0][1] <= -1.5
    assert entry.points[-1][1] == pytest.approx(3.0)
    assert out.points[0][1] == pytest.approx(57.0)
    assert out.points[-1][1] >= 61.0
    assert (row.row_id, row.corridor_width, row.row_start, row.row_end) == ("R3", 2.5, (7.5, 0.0), (7.5, 60.0))


def test_with_room_before_the_row_the_straight_run_is_six_metres() -> None:
    site = farm()
    site = replace(site, lanes=(replace(site.lanes[0], points=((-24, -20), (30, -20))),))
    plan = plan_mission(site, mission_for_row(site, "R3", RowExit.REVERSE), PAPER_A)
    entry = next(s for s in plan.segments if s.kind is K.ENTRY)
    assert entry.points[0][1] == pytest.approx(-6.0)


def test_driving_back_out_in_reverse_keeps_the_axis_and_ends_where_the_robot_drives_forward() -> None:
    site = farm()
    plan = plan_mission(site, mission_for_row(site, "R2", RowExit.REVERSE), PAPER_A)
    kinds = [(s.kind, s.reverse) for s in plan.segments]
    i = kinds.index((K.ROW, True))
    assert kinds[i - 1] == (K.ROW, False)
    assert kinds[i + 1] == (K.EXIT, True)
    forward, back, out = plan.segments[i - 1], plan.segments[i], plan.segments[i + 1]
    assert forward.points[-1] == pytest.approx((5.0, 59.0))
    assert back.points[0] == pytest.approx((5.0, 59.0))
    assert (back.row_start, back.row_end) == ((5.0, 60.0), (5.0, 0.0))
    assert {p[0] for s in (back, out) for p in s.points} == {5.0}
    assert out.points[-1][1] <= -1.5
    assert not plan.segments[-1].reverse


def test_the_next_row_is_entered_from_the_side_the_robot_is_on() -> None:
    site = farm(headland=6.0)
    visits = (
        RowVisit(row_id="R1", exit=RowExit.NEXT_ROW), RowVisit(row_id="R2", exit=RowExit.NEXT_ROW),
        RowVisit(row_id="R4", exit=RowExit.THROUGH),
    )  # fmt: skip
    outbound = mission_for_row(site, "R1", RowExit.REVERSE).outbound
    plan = plan_mission(site, Mission(id="m", name="m", outbound=outbound, visits=visits, inbound=()), PAPER_A)
    assert_drivable(plan)
    entries = [s.row_start for s in plan.segments if s.kind is K.ENTRY]
    assert entries == [(2.5, 0.0), (5.0, 60.0), (10.0, 0.0)]
    turns = [s for s in plan.segments if s.kind is K.HEADLAND]
    assert max(y for _, y in turns[0].points) < 66.0 - PAPER_A.width / 2


@pytest.mark.parametrize(("headland", "least_exit", "entry"), [(12.0, 3.5, 5.0), (5.5, 1.5, 3.0)])
def test_a_turn_is_straight_where_sources_change_as_far_as_the_headland_has_room(
    headland: float, least_exit: float, entry: float
) -> None:
    site = farm(headland=headland)
    outbound = mission_for_row(site, "R1", RowExit.REVERSE).outbound
    visits = (RowVisit(row_id="R1", exit=RowExit.NEXT_ROW), RowVisit(row_id="R2", exit=RowExit.THROUGH))
    plan = plan_mission(site, Mission(id="m", name="m", outbound=outbound, visits=visits, inbound=()), PAPER_A)
    out = next(s for s in plan.segments if s.kind is K.EXIT)
    into = [s for s in plan.segments if s.kind is K.ENTRY][1]
    assert out.points[-1][1] >= 60.0 + least_exit - 1e-6
    assert into.points[0][1] == pytest.approx(60.0 + entry)


def test_a_shallow_headland_is_turned_on_in_three_points() -> None:
    site = farm(headland=3.4, width=1.5)
    outbound = mission_for_row(site, "R1", RowExit.REVERSE).outbound
    visits = (RowVisit(row_id="R1", exit=RowExit.NEXT_ROW), RowVisit(row_id="R2", exit=RowExit.THROUGH))
    plan = plan_mission(site, Mission(id="m", name="m", outbound=outbound, visits=visits, inbound=()), PAPER_A)
    assert_drivable(plan)
    turn = tuple(s for s in plan.segments if s.kind is K.HEADLAND)
    assert [s.reverse for s in turn] == [False, True, False]
    assert swept(turn).bounds[3] < 63.4


def test_curves_are_planned_no_faster_than_the_ground_lets_the_robot_turn() -> None:
    site = farm()
    plan = plan_mission(site, mission_for_row(site, "R2", RowExit.NEXT_ROW), PAPER_A)
    possible = PAPER_A.max_turn_rate / PAPER_A.turn_track_ratio
    for segment in plan.segments:
        if len(segment.points) > 20:
            line = Polyline(np.array(segment.points))
            turned = np.unwrap(line.headings)
            rate = np.abs(turned[5:] - turned[:-5]) / 0.5 * np.array(segment.speeds)[3:-3]
            assert rate.max() < possible


def test_each_waypoint_s_speed_holds_on_the_way_to_it() -> None:
    site = farm()
    outbound = (Waypoint(x=-20, y=-6, speed=0.8), Waypoint(x=-5, y=-6, speed=0.3), Waypoint(x=20, y=-6, speed=0.7))
    plan = plan_mission(site, Mission(id="m", name="m", outbound=outbound, visits=(), inbound=()), PAPER_A)
    road = [(p, v) for s in plan.segments for p, v in zip(s.points, s.speeds, strict=True) if abs(p[1] + 6) < 0.01]
    assert {round(v, 3) for p, v in road if -17 < p[0] < -6 and p[1] < -5.99} == {0.3}
    assert max(v for p, v in road if p[0] > 0) == pytest.approx(0.7)


def test_a_site_without_lanes_and_zones_works() -> None:
    site = replace(farm(), lanes=())
    for row_exit in RowExit:
        assert_drivable(plan_mission(site, mission_for_row(site, "R3", row_exit), PAPER_A))


def test_a_preview_tells_length_and_duration() -> None:
    site = farm()
    plan = plan_mission(site, mission_for_row(site, "R0", RowExit.REVERSE), PAPER_A)
    seen = preview(plan)
    assert seen.length == pytest.approx(sum(line.length for line, _ in legs(plan)), abs=0.1)
    assert seen.length / 0.8 < seen.duration < seen.length / 0.25


@pytest.mark.parametrize("row_exit", list(RowExit))
def test_the_surveyed_vineyard_can_be_planned(shared_data: Path, row_exit: RowExit) -> None:
    posts = json.loads((shared_data / "riseholme" / "riseholme_rtk_gps_poles.geojson").read_text())
    site = replace(import_site(posts).site, warehouse=Warehouse(x=-16.0, y=-18.0, yaw=0.5))
    for row in site.rows:
        plan = plan_mission(site, mission_for_row(site, row.id, row_exit), PAPER_A)
        assert_drivable(plan)
        posts_area = shapely.MultiPoint([(p.x, p.y) for p in site.plants]).buffer(0.05)
        assert swept(plan.segments, 0.1).disjoint(posts_area)


def test_clicking_an_unknown_row_or_without_a_warehouse_says_so() -> None:
    with pytest.raises(MissionError) as caught:
        mission_for_row(replace(farm(), warehouse=None), "R77", RowExit.REVERSE)
    assert len(caught.value.reasons) == 2


def test_unconnected_lanes_are_a_reason() -> None:
    site = farm()
    far = replace(site.lanes[1], points=((200.0, 0.0), (200.0, 50.0)))
    row = Row(id="far", start=(204.0, 0.0), end=(204.0, 40.0))
    site = SiteMap(name="f", datum=site.datum, warehouse=site.warehouse, lanes=(site.lanes[0], far), rows=(row,))
    with pytest.raises(MissionError, match="No lane leads"):
        mission_for_row(site, "far", RowExit.REVERSE)


def test_coming_out_where_no_lane_is_the_robot_drives_round_the_block() -> None:
    site = farm()
    site = replace(site, lanes=site.lanes[:1])
    plan = plan_mission(site, mission_for_row(site, "R2", RowExit.THROUGH), PAPER_A)
    assert_drivable(plan)
    plants = shapely.MultiLineString([((x - 1.25, 0), (x - 1.25, 60)) for x in np.arange(0.0, 17.6, 2.5)])
    assert swept(plan.segments, 0.1).disjoint(plants)


def test_a_speed_that_nobody_can_mean_is_no_motion_backwards_and_no_overflow() -> None:
    points = np.column_stack((np.linspace(0.0, 3.0, 31), np.zeros(31)))
    planned = planned_speeds(points, np.full(31, -1e308), PAPER_A, PlanningParams())
    assert np.all((planned >= 0.0) & (planned <= PAPER_A.max_speed))
