"""The vector map is the site map: there and back is the identity, and it says more."""

from __future__ import annotations

import json
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.errors import SiteError
from navcore.maps.site_import import import_site
from navcore.maps.site_map import SiteMap
from navcore.maps.vector_map.from_site import vector_map_of
from navcore.maps.vector_map.lane_course import course, edge
from navcore.maps.vector_map.to_site import site_of, turns_of
from navcore.maps.vector_map.vector_geojson import vector_map_from_geojson, vector_map_to_geojson
from navcore.maps.vector_map.vector_map import LaneKind, Side
from tests.navcore.maps.test_lossless import sites
from tests.navcore.maps.vector_map.test_lanelets import FARM, MAP, TURN


@settings(max_examples=30, deadline=None)
@given(sites)
def test_from_site_to_site_changes_nothing(site: SiteMap) -> None:
    assert site_of(vector_map_of(site)) == site


def test_from_vector_map_to_vector_map_changes_nothing() -> None:
    assert vector_map_of(site_of(MAP), turns_of(MAP)) == MAP


def test_lanes_that_meet_share_a_node() -> None:
    alley = next(lane for lane in MAP.lanes if lane.id == "r1")
    turn = MAP.of_kind(LaneKind.U_TURN)[0]
    assert turn.begin == alley.begin
    assert len({node.point for node in MAP.nodes}) == len(MAP.nodes)


def test_edges_lie_half_a_width_to_either_side() -> None:
    left, right = (
        next(e for e in MAP.road_edges if (e.kind, e.lane, e.side) == (LaneKind.ALLEY, "r1", side)) for side in Side
    )
    assert MAP.line(left.points) == ((1.0, 8.0), (1.0, 68.0))
    assert MAP.line(right.points) == ((7.0, 8.0), (7.0, 68.0))


def test_every_reference_leads_to_something() -> None:
    points, nodes = {p.id for p in MAP.points}, {n.id for n in MAP.nodes}
    assert all({*lane.points} <= points and {lane.begin, lane.end} <= nodes for lane in MAP.lanes)
    assert all({*edge_.points} <= points for edge_ in MAP.road_edges)
    lanes = {(lane.kind, lane.id) for lane in MAP.lanes}
    assert all((d.kind, d.lane) in lanes for d in MAP.dtlanes)


@given(st.floats(1.0, 30.0), st.booleans(), st.floats(-3.0, 3.0))
def test_curvature_of_an_arc_is_one_over_its_radius(radius: float, left: bool, heading: float) -> None:
    angles = np.arange(0.0, 2.5, 0.1 / radius)
    sign = 1.0 if left else -1.0
    x, y = radius * np.sin(angles), sign * radius * (1.0 - np.cos(angles))
    c, s = math.cos(heading), math.sin(heading)
    found = course(tuple(zip((c * x - s * y).tolist(), (s * x + c * y).tolist(), strict=True)))
    inner = found[(found[:, 0] > 0.5) & (found[:, 0] < found[-1, 0] - 0.5)]
    assert inner[:, 2] == pytest.approx(sign / radius, rel=0.05)  # chords are a little shorter than arcs


def test_a_straight_lane_does_not_curve_and_is_as_long_as_it_is() -> None:
    found = course(((0.0, 0.0), (30.0, 40.0)))
    assert found[-1, 0] == pytest.approx(50.0)  # m
    assert found[:, 1] == pytest.approx(math.atan2(40.0, 30.0))  # rad
    assert found[:, 2] == pytest.approx(0.0, abs=1e-9)  # 1/m


def test_an_edge_passes_a_corner_at_its_distance_and_never_far_out() -> None:
    corner = edge(((0.0, 0.0), (10.0, 0.0), (10.0, 10.0)), 1.0)
    assert corner[1] == pytest.approx((9.0, 1.0), abs=1e-5)  # m
    hairpin = edge(((0.0, 0.0), (10.0, 0.0), (0.0, 0.1)), 1.0)
    assert math.dist(hairpin[1], (10.0, 0.0)) <= 4.1  # m


def test_geojson_comes_back_to_a_tenth_of_a_millimetre() -> None:
    document = json.loads(json.dumps(vector_map_to_geojson(MAP), allow_nan=False))
    back, _ = vector_map_from_geojson(document)
    assert len(back.lanes) == len(MAP.lanes)
    for lane, other in zip(back.lanes, MAP.lanes, strict=True):
        assert (lane.id, lane.kind, lane.width, lane.leaves) == (other.id, other.kind, other.width, other.leaves)
        pairs = zip(back.line(lane.points), MAP.line(other.points), strict=True)
        assert max(math.dist(p, q) for p, q in pairs) < 1e-4  # m
    again, _ = vector_map_from_geojson(vector_map_to_geojson(back))
    assert [lane.id for lane in again.lanes] == [lane.id for lane in back.lanes]


def test_the_station_takes_the_site_out_of_a_vector_map_and_says_what_it_left() -> None:
    imported = import_site(vector_map_to_geojson(MAP))
    assert [row.id for row in imported.site.rows] == [row.id for row in FARM.rows]
    assert any("vector map" in note for note in imported.notes)


def test_a_turn_from_a_row_that_is_not_there_is_refused() -> None:
    document = vector_map_to_geojson(MAP)
    turn = next(f for f in document["features"] if f["properties"]["kind"] == "u_turn")
    turn["properties"]["leaves"] = "r9"
    with pytest.raises(SiteError, match="lacks one of them"):
        vector_map_from_geojson(document)
    assert TURN.leaves == "r1"
