"""Rows, headlands, lanes and turns found in a 3D map, and missions that may be started on them."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest

from navcore.errors import CloudError
from navcore.geometry.point_cloud import PointCloud
from navcore.mapping.row_map.cloud_in_map import read_seen_cloud
from navcore.mapping.row_map.map_rows import map_rows
from navcore.mapping.row_map.row_map import RowMap, added
from navcore.mapping.row_map.u_turns import u_turns
from navcore.mapping.trellis.seen_cloud import SeenCloud
from navcore.maps.cloud_files.cloud_file import write_cloud
from navcore.maps.cloud_files.laz import laz_bytes
from navcore.maps.mission import RowExit
from navcore.maps.site_map import Datum, SiteMap, Warehouse, ZoneKind
from navcore.maps.vector_map.from_site import vector_map_of
from navcore.maps.vector_map.vector_map import LaneKind
from navcore.planning.mission_planner import mission_for_row
from navcore.planning.params import PlanningParams
from navcore.planning.validation import find_problems
from navcore.vehicle import SCOUT_2
from tests.navcore.mapping.standing_block import StandingBlock

BLOCK = StandingBlock(lines=3, posts=4)
DATUM = Datum(lat_deg=41.5, lon_deg=-5.4, height_m=700.0)
FARM = SiteMap(name="Farm", datum=DATUM, warehouse=Warehouse(x=-6.0, y=-9.0, yaw=math.pi / 2))


@cache
def found() -> RowMap:
    return map_rows([BLOCK.seen()])[0]


@cache
def site() -> SiteMap:
    return added(FARM, found())


def test_each_alley_between_two_lines_of_posts_is_a_row() -> None:
    rows = found().rows
    assert len(rows) == 2
    for row, middle in zip(sorted(rows, key=lambda r: r.start[1]), (3.0, 9.0), strict=True):
        ends = sorted((row.start, row.end))
        assert ends[0] == pytest.approx((0.0, middle), abs=0.05)  # m
        assert ends[1] == pytest.approx((BLOCK.length, middle), abs=0.05)  # m
        assert row.width == pytest.approx(6.0, abs=0.05)  # m
        assert row.post_spacing == pytest.approx(6.0, abs=0.1)  # m
        assert row.plant_spacing == pytest.approx(6.0, abs=0.1)  # m


def test_vines_as_tall_as_their_posts_still_make_rows_and_the_operator_is_told() -> None:
    vineyard = StandingBlock(lines=3, posts=13, width=3.0, spacing=1.5)
    seen = map_rows([vineyard.seen(rays=False)])[0]
    assert len(seen.rows) == 2
    for row, middle in zip(sorted(seen.rows, key=lambda r: r.start[1]), (1.5, 4.5), strict=True):
        ends = sorted((row.start, row.end))
        assert ends[0] == pytest.approx((0.0, middle), abs=0.1)  # m
        assert ends[1] == pytest.approx((vineyard.length, middle), abs=0.1)  # m
    assert any("taken for posts" in note for note in seen.notes)
    assert not any("taken for posts" in note for note in found().notes)


def test_the_road_between_two_blocks_is_no_row() -> None:
    vineyard = StandingBlock(lines=8, posts=13, width=3.0, spacing=1.5)
    road = tuple(range(3 * vineyard.posts, 5 * vineyard.posts))
    seen = map_rows([vineyard.seen(rays=False, missing=road)])[0]
    assert len(seen.rows) == 4
    assert max(row.width for row in seen.rows) < 3.5  # m, the road is 9 m wide


def test_the_open_ground_before_the_rows_becomes_headlands() -> None:
    headlands = [zone for zone in found().zones if zone.kind is ZoneKind.HEADLAND]
    assert len(headlands) == 2
    reach = sorted((min(x for x, _ in zone.polygon), max(x for x, _ in zone.polygon)) for zone in headlands)
    assert reach[0] == pytest.approx((-12.0, 0.0), abs=1.0)  # m
    assert reach[1] == pytest.approx((BLOCK.length, BLOCK.length + 12.0), abs=1.0)  # m


def test_a_mission_through_each_row_and_out_of_it_in_each_way_may_be_started() -> None:
    for row in site().rows:
        for way_out in RowExit:
            assert find_problems(site(), mission_for_row(site(), row.id, way_out), SCOUT_2) == ()


def test_turns_keep_the_least_radius_and_stay_on_the_headlands() -> None:
    turns = u_turns(site(), SCOUT_2)
    assert len(turns) == 2
    sharpest = max(abs(d.curvature) for d in vector_map_of(site(), turns).dtlanes if d.kind is LaneKind.U_TURN)
    assert sharpest <= 1.05 / min(PlanningParams().radii)  # 1/m
    assert all(-12.0 < x < BLOCK.length + 12.0 for turn in turns for x, _ in turn.line)


def test_where_the_headland_is_too_shallow_no_turn_is_drawn() -> None:
    low = tuple(replace(zone, polygon=tuple((max(x, -1.5), y) for x, y in zone.polygon)) for zone in site().zones)
    assert len(u_turns(replace(site(), zones=low), SCOUT_2)) == 1


def test_what_stands_on_a_headland_becomes_a_keep_out_zone_and_is_said() -> None:
    rng = np.random.default_rng(3)
    pole = np.column_stack((-5.0 + rng.normal(0.0, 0.1, (400, 1)), 6.0 + rng.normal(0.0, 0.1, (400, 1)),
                            rng.uniform(0.0, 1.4, (400, 1)) - 0.1))  # fmt: skip
    cloud = BLOCK.seen(rays=False)
    with_pole = map_rows([SeenCloud(points=np.concatenate((cloud.points, pole)))])[0]
    standing = [zone for zone in with_pole.zones if zone.kind is ZoneKind.KEEP_OUT]
    assert len(standing) == 1
    assert np.mean(standing[0].polygon, axis=0) == pytest.approx((-5.0, 6.0), abs=0.6)  # m
    assert any("stands on the headland" in note for note in with_pole.notes)


def test_one_line_of_posts_makes_no_row_and_says_what_to_do() -> None:
    alone = map_rows([StandingBlock(lines=1, posts=5).seen()])[0]
    assert alone.rows == ()
    assert "no row to drive" in alone.notes[0]


def test_ids_that_the_site_has_are_not_given_again() -> None:
    twice = added(site(), found())
    ids = [item.id for items in (twice.rows, twice.lanes, twice.zones) for item in items]
    assert len(set(ids)) == len(ids)


def test_the_same_map_gives_the_same_rows() -> None:
    assert map_rows([BLOCK.seen()])[0] == found()


def test_a_surveyors_file_lands_where_it_lies_on_the_earth(tmp_path: Path) -> None:
    points = np.array(((0.0, 0.0, 5.0), (10.0, 0.0, 5.0), (0.0, 10.0, 6.0)))
    # UTM 30N has its central meridian at 3 W: grid north is off by the difference times sin(latitude).
    convergence_deg = 2.4 * math.sin(math.radians(41.5))
    path = tmp_path / "block.laz"
    path.write_bytes(laz_bytes(PointCloud.of(points), origin=(299680.0, 4597045.0, 0.0), epsg=25830))
    cloud, told = read_seen_cloud(path, DATUM)
    assert np.hypot(*cloud.points[0, :2]) < 50.0  # m
    assert np.linalg.norm(cloud.points[1, :2] - cloud.points[0, :2]) == pytest.approx(10.0, abs=0.01)  # m
    turned = math.degrees(math.atan2(*(cloud.points[1, :2] - cloud.points[0, :2])[::-1]))
    assert turned == pytest.approx(convergence_deg, abs=0.02)  # deg
    assert "carried over" in told


def test_a_map_of_another_farm_and_one_on_an_unknown_grid_are_refused(tmp_path: Path) -> None:
    path = tmp_path / "far.laz"
    path.write_bytes(laz_bytes(PointCloud.of(np.ones((3, 3))), origin=(500000.0, 5200000.0, 0.0), epsg=25832))
    with pytest.raises(CloudError, match="does not lie on this farm"):
        read_seen_cloud(path, DATUM)
    path.write_bytes(laz_bytes(PointCloud.of(np.ones((3, 3))), origin=(500000.0, 5200000.0, 0.0)))
    with pytest.raises(CloudError, match="does not tell which"):
        read_seen_cloud(path, DATUM)
    write_cloud(tmp_path / "none.pcd", PointCloud.of(np.zeros((0, 3))))
    with pytest.raises(CloudError, match="no points"):
        read_seen_cloud(tmp_path / "none.pcd", DATUM)
