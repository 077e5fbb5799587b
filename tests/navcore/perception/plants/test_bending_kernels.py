"""The quick arithmetic of all bends at once is that of each alone, by the rule book."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.perception.plants.bending_kernels import averaged

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
