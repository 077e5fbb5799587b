"""A whole map is searched for where a cloud was taken, in steps that take about the same time."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.geometry.se2 import SE2
from navcore.geometry.se3 import SE3
from navcore.localization.ndt.birds_eye import BirdsEye
from navcore.localization.ndt.place_search import PlaceSearch, PlaceSearchParams, Region
from navcore.maps.ndt.ndt_map import NdtMap
from tests.navcore.localization.ndt.trellis import mapped_orchard, scan_at

PIXEL_M, STEP_RAD = 0.5, PlaceSearchParams().turn_step


@pytest.fixture(scope="module")
def eye() -> BirdsEye:
    seen = BirdsEye.of(mapped_orchard())
    assert seen is not None
    return seen


def found(eye: BirdsEye, at: SE2, region: Region | None = None) -> list[SE2]:
    search = PlaceSearch(eye, scan_at(SE3.from_rpy((at.x, at.y, 0.0), 0.0, 0.0, at.yaw), 3, n=16_000), region)
    while not search.done:
        search.step()
    return search.places()


def is_near(place: SE2, at: SE2) -> bool:
    turned = abs(math.remainder(place.yaw - at.yaw, 2.0 * math.pi))
    return math.dist((place.x, place.y), (at.x, at.y)) <= 2.0 * PIXEL_M and turned <= 1.5 * STEP_RAD


@pytest.mark.parametrize("at", [SE2(0.2, 0.1, 0.02), SE2(-6.4, 5.9, 3.0), SE2(9.1, -6.3, -1.0)])
def test_the_true_place_is_among_those_that_fit(eye: BirdsEye, at: SE2) -> None:
    places = found(eye, at)
    assert any(is_near(place, at) for place in places)
    assert len(places) <= PlaceSearchParams().most


def test_a_region_keeps_the_search_in_it(eye: BirdsEye) -> None:
    region = Region(at=SE2(1.0, -0.5, 0.3), reach=2.0, turn=math.radians(40.0))
    places = found(eye, SE2(0.2, 0.1, 0.02), region)
    assert any(is_near(place, SE2(0.2, 0.1, 0.02)) for place in places)
    assert all(region.holds(place, more=PIXEL_M * 1.5, more_turn=STEP_RAD * 1.01) for place in places)


def test_where_the_map_has_nothing_no_place_is_found(eye: BirdsEye) -> None:
    assert found(eye, SE2(), Region(at=SE2(400.0, 0.0, 0.0), reach=2.0, turn=0.5)) == []


def test_one_step_looks_at_few_headings_of_a_large_map(eye: BirdsEye) -> None:
    """So that its time is bounded: the work of all steps is divided by the map's size."""
    points = scan_at(SE3.identity(), 3)
    few = PlaceSearch(eye, points, params=PlaceSearchParams(pixels=1))
    steps = 0
    while not few.done:
        few.step()
        steps += 1
    assert steps == round(2.0 * math.pi / STEP_RAD)


def test_the_ground_is_where_it_lies(eye: BirdsEye) -> None:
    heights = [eye.height(float(x), float(y)) for x, y in np.random.default_rng(2).uniform(-15.0, 15.0, (20, 2))]
    assert max(abs(height) for height in heights) < 0.2  # m, of waves of 0.1 m
    assert math.isfinite(eye.height(1e4, -1e4))


def test_an_empty_map_has_no_view() -> None:
    assert BirdsEye.of(NdtMap()) is None
