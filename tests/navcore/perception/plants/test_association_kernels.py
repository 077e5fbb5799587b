"""How clearly a box is a plant, and which plants are in sight, by the plain rules."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.perception.plants.association_kernels import in_sight, lead

seeds = st.integers(0, 10_000)


@settings(deadline=None)
@given(seeds, st.integers(0, 8), st.integers(1, 12))
def test_the_best_plant_leads_by_what_the_next_one_elsewhere_costs_more(seed: int, n: int, m: int) -> None:
    rng = np.random.default_rng(seed)
    costs, xy = rng.uniform(0.0, 9.0, (n, m)), rng.uniform(0.0, 0.6, (m, 2))
    for told, row in zip(lead(costs, xy, 0.2), costs, strict=True):
        best = int(np.argmin(row))
        elsewhere = row[np.hypot(*(xy - xy[best]).T) > 0.2]
        assert told == (elsewhere.min() - row[best] if len(elsewhere) else np.inf)


@settings(deadline=None)
@given(seeds, st.integers(0, 20))
def test_in_sight_is_what_stands_well_inside_the_picture_with_nothing_nearer_before_it(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    x, y, diameter = rng.uniform(-2.0, 8.0, n), rng.uniform(-4.0, 4.0, n), rng.uniform(0.03, 0.3, n)
    told = in_sight(x, y, diameter, (465.0, 320.0), 640, 6.0)
    near = (x > 0.3) & (np.hypot(x, y) < 6.0)
    with np.errstate(divide="ignore"):
        u, half = 320.0 - 465.0 * y / x, 0.5 * 465.0 * diameter / x + 4.0
    for i in range(n):
        before = near & (x < x[i] - 0.1) & (np.abs(u - u[i]) < half + half[i])
        assert told[i] == (near[i] and x[i] > 1.0 and 25.6 < u[i] < 614.4 and not before.any())


def test_something_before_a_plant_hides_it() -> None:
    x, thick = np.array((2.0, 4.0)), np.full(2, 0.1)
    assert in_sight(x, np.array((0.0, 0.0)), thick, (465.0, 320.0), 640, 6.0).tolist() == [True, False]
    assert in_sight(x, np.array((0.0, 1.0)), thick, (465.0, 320.0), 640, 6.0).tolist() == [True, True]
