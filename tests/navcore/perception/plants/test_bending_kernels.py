"""The quick arithmetic of all bends at once is that of each alone, by the rule book."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.perception.plants.bending_kernels import about, averaged, basis, bends, inverse_root, shared

Floats = NDArray[np.float64]


def one_model(
    off: Floats, basis: Floats, variance: Floats, prior: Floats, asked: Floats
) -> tuple[float, Floats, Floats]:
    """Logarithm of how likely places (N,) are, and what is asked for with its covariance: by Gaussians alone."""
    unknowns = np.diag(1.0 / prior)
    seen = basis @ unknowns @ basis.T + np.diag(variance)
    gain = asked @ unknowns @ basis.T @ np.linalg.inv(seen)
    likely = -0.5 * (off @ np.linalg.solve(seen, off) + np.linalg.slogdet(seen)[1])
    return likely, gain @ off, asked @ unknowns @ asked.T - gain @ basis @ unknowns @ asked.T


@pytest.mark.parametrize("seed", range(5))
def test_it_is_the_average_of_the_models_by_how_likely_each_is(seed: int) -> None:
    rng, n = np.random.default_rng(seed), 20
    x = rng.uniform(-8.0, 8.0, n)
    basis, bends = np.column_stack((np.ones(n), x)), np.vstack((np.clip(x / 3.0, -0.5, 0.5), 0.02 * x * x))
    off = 0.1 + 0.02 * x + 0.3 * bends[seed % 2] + rng.normal(0.0, 0.05, n)
    variances = np.array(((0.05**2,), (0.1**2,))) + rng.uniform(0.0, 0.01, n)
    prior, chances = np.array((4.0, 200.0, 16.0)), np.log((0.5, 0.2, 0.3))
    asked, asked_bends = np.array(((1.0, 0.0), (1.0, 2.0))), np.array(((0.0, 0.4), (0.0, 0.08)))
    models, weights = [], []
    for variance in variances:
        for k in range(3):
            more = np.zeros(n) if k == 0 else bends[k - 1]
            asked_more = np.zeros(2) if k == 0 else asked_bends[k - 1]
            found = one_model(
                off, np.column_stack((basis, more)), variance, prior, np.column_stack((asked, asked_more))
            )  # fmt: skip
            models.append(found)
            weights.append(found[0] + chances[k])
    share = np.exp(np.array(weights) - max(weights))
    share /= share.sum()
    mean = sum(s * m for s, (_, m, _) in zip(share, models, strict=True))
    spread = sum(s * (c + np.outer(m - mean, m - mean)) for s, (_, m, c) in zip(share, models, strict=True))
    told, covariance = averaged(basis, off, 1.0 / variances, bends, asked, asked_bends, prior, chances)
    assert told == pytest.approx(mean, abs=1e-9)  # m
    assert covariance == pytest.approx(spread, abs=1e-9)  # m^2


@pytest.mark.parametrize("seed", range(5))
def test_the_root_is_that_of_what_places_and_prior_leave_unknown(seed: int) -> None:
    rng = np.random.default_rng(seed)
    seen, weights, prior = rng.normal(0.0, 1.0, (12, 4)), rng.uniform(0.5, 9.0, 12), rng.uniform(0.1, 5.0, 4)
    information = seen.T @ np.diag(weights) @ seen + np.diag(prior)
    root, told = inverse_root(seen, weights, prior)
    assert root.T @ root == pytest.approx(np.linalg.inv(information), abs=1e-12)
    logs = np.log(weights).sum() + np.log(prior).sum() - np.linalg.slogdet(information)[1]
    assert told == pytest.approx(logs, abs=1e-9)


@pytest.mark.parametrize("seed", range(10))
def test_plants_stand_beside_the_line_that_is_nearest_if_they_do_at_all(seed: int) -> None:
    rng = np.random.default_rng(seed)
    offset, heading, width = rng.uniform(-0.4, 0.4), rng.uniform(-0.3, 0.3), 3.0
    plants = rng.uniform((-5.0, -6.0, 0.01, 0.0), (9.0, 6.0, 0.1, 1.0), (80, 4))
    c, s = np.cos(heading), np.sin(heading)
    x, y = plants[:, 0] * c + plants[:, 1] * s, plants[:, 1] * c - plants[:, 0] * s - offset
    lines = np.array((3.0, 1.0, -1.0, -3.0))
    line = lines[np.argmin(np.abs(y[:, None] - lines * width / 2), axis=1)]
    off = y - line * width / 2
    on = (np.abs(off) <= 0.5) & ((np.abs(line) == 1.0) | (plants[:, 3] >= 0.6))
    told = about((offset, heading, width), plants, 0.6, 0.5)
    assert told[0] == pytest.approx(x[on], abs=1e-12)
    assert told[1].tolist() == line[on].tolist()
    assert told[2] == pytest.approx(off[on], abs=1e-12)
    assert told[3] == pytest.approx(np.column_stack((plants[on, 2] ** 2, plants[on, 3])))


def test_a_line_is_moved_by_the_corridor_or_by_its_own_offset_and_turn_too() -> None:
    x, side = np.array((2.0, 3.0, 4.0, 5.0)), np.array((1.0, -1.0, 3.0, -3.0))
    assert basis(x, side).tolist() == [
        [1.0, 2.0, 0.5, 0.0, 0.0, 0.0, 0.0], [1.0, 3.0, -0.5, 0.0, 0.0, 0.0, 0.0],
        [1.0, 4.0, 1.5, 1.0, 4.0, 0.0, 0.0], [1.0, 5.0, -1.5, 0.0, 0.0, 1.0, 5.0],
    ]  # fmt: skip


def test_a_shift_goes_from_one_side_to_the_other_over_its_length_and_a_curve_with_the_square() -> None:
    x = np.array((-9.0, 1.0, 2.0, 2.5, 3.0, 9.0))
    shift, curve = bends(x, np.array(((2.0, 2.0),)), 0.1)
    assert shift.tolist() == [-0.5, -0.5, 0.0, 0.25, 0.5, 0.5]
    assert curve == pytest.approx(0.05 * x**2)


def test_a_tree_and_its_stake_count_once_and_trees_a_metre_apart_each() -> None:
    along = np.array((0.0, 0.3, 1.4, 1.5, 5.0, 5.2))
    line = np.array((1.0, 1.0, 1.0, -1.0, -1.0, -1.0))
    sure = np.array((1.0, 1.0, 0.8, 0.9, 0.3, 0.2))
    assert shared(along, line, sure, 0.6) == pytest.approx((0.5, 0.5, 0.8, 0.9, 0.3, 0.2))
    assert shared(along, line, sure, 0.0) == pytest.approx(sure)
