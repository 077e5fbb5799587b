"""The orchard stands where the site says."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.errors import InputError
from navcore.maps.site_map import Datum, Lane, Plant, PlantKind, Row, SiteMap, Warehouse
from navcore.sim.orchard import Floats, Ints, Orchard, OrchardParams, Season, Standing, Trellis
from navcore.sim.planting import build_orchard

DATUM = Datum(lat_deg=41.0, lon_deg=-5.0, height_m=700.0)


def farm(rows: int = 3, *, width: float = 3.0, length: float = 60.0, angle: float = 0.0) -> SiteMap:
    """Parallel rows whose neighbours share their lines of plants, turned by `angle`."""
    c, s = math.cos(angle), math.sin(angle)

    def turned(x: float, y: float) -> tuple[float, float]:
        return x * c - y * s, x * s + y * c

    alleys = tuple(
        Row(id=f"r{i}", start=turned(0.0, i * width), end=turned(length, i * width), width=width) for i in range(rows)
    )
    lane = Lane(id="lane", points=(turned(-8.0, -10.0), turned(-8.0, 20.0)))
    home = turned(-8.0, -14.0)
    return SiteMap(
        name="farm", datum=DATUM, rows=alleys, lanes=(lane,),
        warehouse=Warehouse(x=home[0], y=home[1], yaw=angle + math.pi / 2),
    )  # fmt: skip


def distance_to_lines(orchard: Orchard, points: Floats, line: Ints) -> Floats:
    """Distance of points (N, 2) from the infinite line each belongs to, m."""
    x0, y0, x1, y1 = orchard.plant_lines[line].T
    area = (x1 - x0) * (points[:, 1] - y0) - (y1 - y0) * (points[:, 0] - x0)
    return np.asarray(np.abs(area) / np.hypot(x1 - x0, y1 - y0))


@given(angle=st.floats(-3.1, 3.1), rows=st.integers(1, 6))
def test_neighbouring_rows_share_their_line_of_plants(angle: float, rows: int) -> None:
    orchard = build_orchard(farm(rows, angle=angle), OrchardParams())
    assert len(orchard.plant_lines) == rows + 1
    assert sum(len(r) for r in orchard.line_rows) == 2 * rows


@given(angle=st.floats(-3.1, 3.1), seed=st.integers(0, 99))
def test_plants_stand_within_their_scatter_of_the_lines(angle: float, seed: int) -> None:
    orchard = build_orchard(farm(angle=angle), OrchardParams(seed=seed, scatter_std=0.03))
    assert distance_to_lines(orchard, orchard.trunks, orchard.trunk_line).max() < 5 * 0.03
    assert distance_to_lines(orchard, orchard.posts, orchard.post_line).max() < 5 * 0.03


def test_posts_stand_at_both_ends_of_every_line() -> None:
    orchard = build_orchard(farm(1), OrchardParams(scatter_std=0.0))
    first = orchard.posts[orchard.post_line == 0]
    assert first[0, :2] == pytest.approx(orchard.plant_lines[0, :2], abs=1e-9)
    assert first[-1, :2] == pytest.approx(orchard.plant_lines[0, 2:], abs=1e-9)
    assert len(first) == 11


def test_same_seed_gives_the_same_orchard_bit_for_bit() -> None:
    a, b = (build_orchard(farm(), OrchardParams(seed=4)) for _ in range(2))
    assert a.trunks.tobytes() == b.trunks.tobytes()
    assert a.posts.tobytes() == b.posts.tobytes()
    assert a.trunks.tobytes() != build_orchard(farm(), OrchardParams(seed=5)).trunks.tobytes()


def test_missing_share_leaves_gaps_among_trunks_only() -> None:
    full = build_orchard(farm(), OrchardParams(missing_share=0.0))
    gaps = build_orchard(farm(), OrchardParams(missing_share=0.3))
    assert len(gaps.trunks) / len(full.trunks) == pytest.approx(0.7, abs=0.12)
    assert len(gaps.posts) == len(full.posts)


def test_surveyed_posts_are_kept_and_pull_their_line_along() -> None:
    site = farm(1)
    plants = tuple(Plant(x=float(x), y=1.7, kind=PlantKind.POST) for x in range(0, 61, 6))
    surveyed = SiteMap(name="s", datum=DATUM, rows=site.rows, plants=plants)
    orchard = build_orchard(surveyed, OrchardParams())
    upper = int(np.argmax(orchard.plant_lines[:, 1]))
    assert orchard.plant_lines[upper, [1, 3]] == pytest.approx([1.7, 1.7], abs=1e-6)
    assert {(p.x, p.y) for p in plants} == {(x, y) for x, y in orchard.posts[orchard.post_line == upper][:, :2]}
    assert np.abs(orchard.trunks[orchard.trunk_line == upper][:, 1] - 1.7).max() < 0.15


def test_a_surveyed_tree_far_from_all_rows_stands_alone() -> None:
    site = farm(1)
    lone = SiteMap(name="s", datum=DATUM, rows=site.rows, plants=(Plant(x=30.0, y=30.0, kind=PlantKind.TRUNK),))
    orchard = build_orchard(lone, OrchardParams())
    assert orchard.trunks[orchard.trunk_line == -1][:, :2].tolist() == [[30.0, 30.0]]


@pytest.mark.parametrize("trellis", list(Trellis))
def test_trunks_end_where_the_canopy_begins(trellis: Trellis) -> None:
    orchard = build_orchard(farm(), OrchardParams(trellis=trellis))
    assert np.abs(orchard.trunks[:, 3] - orchard.canopy_bottom_m).max() < 0.1 * orchard.canopy_bottom_m
    assert orchard.trunks[0, 5] == (Standing.TREE if trellis is Trellis.TREES else Standing.VINE)


def test_leaves_follow_the_season() -> None:
    density = [build_orchard(farm(1), OrchardParams(season=s)).leaf_density for s in Season]
    assert density[0] == 0.0
    assert max(density) == density[list(Season).index(Season.MATURING)] == 1.0


def test_the_shed_keeps_clear_of_road_and_robot() -> None:
    site = farm()
    shed = build_orchard(site, OrchardParams()).shed
    assert site.warehouse is not None
    assert shed is not None
    assert math.hypot(shed.x - site.warehouse.x, shed.y - site.warehouse.y) > shed.depth / 2 + 1.0


def test_an_empty_site_is_an_empty_orchard() -> None:
    orchard = build_orchard(SiteMap(name="bare", datum=DATUM), OrchardParams())
    assert (orchard.posts.shape, orchard.trunks.shape, orchard.plant_lines.shape) == ((0, 6), (0, 6), (0, 4))
    assert orchard.shed is None


@pytest.mark.parametrize("value", [float("nan"), -0.1, 0.95])
def test_an_impossible_share_of_missing_plants_is_refused(value: float) -> None:
    with pytest.raises(InputError, match="missing_share"):
        OrchardParams(missing_share=value)
