"""Plants along a row, by compiled arithmetic, are met as by the plain rule."""

from __future__ import annotations

from statistics import median

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.perception.along_kernels import RECENT, further_along, nearest
from navcore.perception.plants_along import PlantsAlong

seeds, counts = st.integers(0, 10_000), st.integers(0, 15)


@settings(deadline=None)
@given(seeds, st.integers(0, 120))
def test_a_place_is_that_of_the_nearest_plant_of_its_side_met_of_late(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    along, left, place = rng.uniform(0.0, 9.0, n), rng.random(n) < 0.5, rng.uniform(0.0, 9.0)
    able = [i for i in range(max(0, n - RECENT), n) if left[i] and abs(along[i] - place) <= 0.3]
    expected = min(able, key=lambda i: abs(along[i] - place), default=-1)
    assert nearest(along, left, True, place, 0.3) == expected


@settings(deadline=None)
@given(seeds, counts, counts, st.integers(1, 3))
def test_how_much_further_plants_seem_to_stand_is_the_median_of_those_well_known(
    seed: int, n: int, feet: int, least: int
) -> None:
    rng = np.random.default_rng(seed)
    along, left, sightings = rng.uniform(0.0, 9.0, n), rng.random(n) < 0.5, rng.integers(1, 6, n)
    seen, seen_left = rng.uniform(0.0, 9.0, feet), rng.random(feet) < 0.5
    off = []
    for place, side in zip(seen, seen_left, strict=True):
        i = nearest(along, left, bool(side), place, 0.3)
        if i >= 0 and sightings[i] >= 3:
            off.append(float(place - along[i]))
    expected = median(off) if len(off) >= least else 0.0
    assert further_along(along, sightings, left, seen, seen_left, 0.3, 3, least) == expected


@settings(deadline=None)
@given(seeds, counts)
def test_a_plant_is_the_mean_of_its_sightings_and_two_feet_close_together_are_one(seed: int, n: int) -> None:
    rng, plants = np.random.default_rng(seed), PlantsAlong()
    places: list[tuple[bool, float, int]] = []
    for _ in range(3):
        along, left = rng.uniform(0.0, 6.0, n), rng.random(n) < 0.5
        plants.remember(left, along, 0.35, 2)
        for side, foot in zip(left.tolist(), along.tolist(), strict=True):
            near = [i for i, (s, a, _) in enumerate(places) if s == side and abs(a - foot) <= 0.35]
            if not near:
                places.append((side, foot, 1))
                continue
            i = min(near, key=lambda i: abs(places[i][1] - foot))
            _, place, count = places[i]
            places[i] = side, place + (foot - place) / min(count + 1, 2), count + 1
    for i, (side, place, _) in enumerate(places):
        assert plants.nearest(side, place, 1e-9) == i
    left, along = (np.array([place[k] for place in places]) for k in (0, 1))
    told = plants.further(left.astype(np.bool_), along.astype(np.float64) + 1e-6, 0.1, 3, 1)
    assert told == pytest.approx(1e-6 if any(count >= 3 for _, _, count in places) else 0.0, abs=1e-9)
