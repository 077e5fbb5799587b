"""The world differs from the map in every way the design names."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.maps.site_map import Plant, PlantKind, SiteMap
from navcore.sim.map_error import NO_MAP_ERROR, MapErrorParams, perturb

SEEDS = range(20)


def true_sites(farm: SiteMap, params: MapErrorParams | None = None) -> list[SiteMap]:
    return [perturb(farm, params or MapErrorParams(), np.random.default_rng(seed)) for seed in SEEDS]


def middle(site: SiteMap) -> np.ndarray:
    return np.asarray(np.mean([np.add(row.start, row.end) / 2 for row in site.rows], axis=0))


def test_rows_are_shifted_by_three_to_eight_decimetres(farm: SiteMap) -> None:
    shifts = [np.linalg.norm(middle(site) - middle(farm)) for site in true_sites(farm)]
    assert min(shifts) > 0.2
    assert max(shifts) < 1.0


def test_rows_are_turned_by_up_to_half_a_degree_and_stay_parallel(farm: SiteMap) -> None:
    turns = []
    for site in true_sites(farm):
        of_rows = [math.degrees(math.atan2(r.start[0] - r.end[0], r.end[1] - r.start[1])) for r in site.rows]
        assert np.std(of_rows) < 0.1
        turns.append(np.mean(of_rows))
    assert 0.2 < np.max(np.abs(turns)) < 0.6


def test_rows_end_elsewhere_than_drawn(farm: SiteMap) -> None:
    lengths = [math.dist(row.start, row.end) for site in true_sites(farm) for row in site.rows]
    assert 0.2 < np.std(lengths) < 0.8


def test_plants_are_missing_singly_and_in_gaps(farm: SiteMap) -> None:
    site = true_sites(farm)[0]
    trunks = [p for p in site.plants if p.kind is PlantKind.TRUNK]
    drawn = 7 * round(60.0 / 1.5)
    assert 0.6 * drawn < len(trunks) < 0.97 * drawn
    # Along one line of plants the longest gap is several plants wide.
    column = sorted(p.y for p in trunks if abs(p.x - min(q.x for q in trunks)) < 1.2)
    assert max(np.diff(column)) > 2.5


def test_trunks_stand_about_five_centimetres_off_their_line(farm: SiteMap) -> None:
    site = true_sites(farm, replace(MapErrorParams(), shift_m=(0.0, 0.0), turn_deg=0.0, line_std_m=0.0))[0]
    left = np.array([p.x for p in site.plants if p.kind is PlantKind.TRUNK])
    off = left - (18.5 + 3.0 * np.round((left - 18.5) / 3.0))
    assert 0.03 < np.std(off) < 0.07


def test_true_rows_lie_midway_between_their_plants(farm: SiteMap) -> None:
    site = true_sites(farm)[3]
    row = site.rows[2]
    (x0, y0), (x1, y1) = row.start, row.end
    ux, uy = (x1 - x0) / math.dist(row.start, row.end), (y1 - y0) / math.dist(row.start, row.end)
    beside = np.array([(p.y - y0) * ux - (p.x - x0) * uy for p in site.plants])
    left, right = beside[(beside > 0) & (beside < 2.5)], beside[(beside < 0) & (beside > -2.5)]
    assert np.mean(left) == pytest.approx(-np.mean(right), abs=0.04)
    assert row.width == pytest.approx(np.mean(left) - np.mean(right), abs=0.05)


def test_true_rows_begin_and_stop_where_the_plants_beside_them_do(farm: SiteMap) -> None:
    site = true_sites(farm)[3]
    row = site.rows[2]
    (x0, y0), length = row.start, math.dist(row.start, row.end)
    ux, uy = (row.end[0] - x0) / length, (row.end[1] - y0) / length
    posts = [((p.x - x0) * ux + (p.y - y0) * uy, (p.y - y0) * ux - (p.x - x0) * uy) for p in site.plants
             if p.kind is PlantKind.POST]  # fmt: skip
    sides = [[s for s, aside in posts if 0.0 < side * aside < 2.5] for side in (1.0, -1.0)]
    assert np.mean([min(side) for side in sides]) == pytest.approx(0.0, abs=0.1)  # m
    assert np.mean([max(side) for side in sides]) == pytest.approx(length, abs=0.1)  # m


def test_without_error_the_world_is_the_map(farm: SiteMap) -> None:
    site = perturb(farm, NO_MAP_ERROR, np.random.default_rng(1))
    assert site.rows[1].start == pytest.approx(farm.rows[1].start, abs=1e-9)
    assert site.lanes[0].points[1] == pytest.approx(farm.lanes[0].points[1], abs=1e-9)


def test_surveyed_plants_move_with_the_rest_and_none_is_lost(farm: SiteMap) -> None:
    plants = tuple(Plant(x=18.5, y=6.0 + 6 * i, kind=PlantKind.POST) for i in range(10))
    site = perturb(replace(farm, plants=plants), MapErrorParams(), np.random.default_rng(4))
    assert len(site.plants) == 10
    assert 0.1 < math.hypot(site.plants[5].x - 18.5, site.plants[5].y - 36.0) < 1.6


def test_the_same_seed_makes_the_same_world(farm: SiteMap) -> None:
    assert true_sites(farm)[7] == true_sites(farm)[7]
    assert true_sites(farm)[7] != true_sites(farm)[8]
