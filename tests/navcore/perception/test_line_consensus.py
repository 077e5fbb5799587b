"""The lines on which most rays lie, against the plainest way to find them."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.perception.line_consensus import GATE, best_lines

HEIGHT = 0.8
# Ray 1-sigma across and down; plants about their line, m; bend of rows, 1/m; scanned plants, m.
NOISE = (0.003, 0.003, 0.06, 0.0005, 0.1)


def rays_of(rng: np.random.Generator, n: int) -> NDArray[np.float64]:
    """Half on one line 1.5 m to the left, half anywhere."""
    ahead = rng.uniform(2.0, 12.0, n)
    across = np.where(np.arange(n) % 2 == 0, 1.5 + 0.05 * ahead, rng.uniform(-6.0, 6.0, n))
    return np.column_stack((across, np.full(n, HEIGHT))) / ahead[:, None]


def support(line: tuple[float, float], rays: NDArray[np.float64]) -> float:
    m, b = line
    reach = HEIGHT / rays[:, 1]
    variance = NOISE[0] ** 2 + (b * NOISE[1]) ** 2 + ((NOISE[2] + NOISE[3] * reach**2) / reach) ** 2
    e = rays[:, 0] - m - b * rays[:, 1]
    return float(0.5 * np.maximum(GATE**2 - e**2 / variance, 0.0).sum())


def all_lines(rays: NDArray[np.float64]) -> list[tuple[float, float]]:
    lines = []
    for one, other in itertools.combinations(rays, 2):
        if abs(one[1] - other[1]) >= 0.02:
            b = float((one[0] - other[0]) / (one[1] - other[1]))
            lines.append((float(one[0] - b * one[1]), b))
    return [(m, b) for m, b in lines if abs(m) < 1.5 and abs(b) < 8.0]


@pytest.mark.parametrize("n", [3, 7, 8, 9, 24, 41])
def test_best_line_is_the_best_of_all_lines_through_two_rays(n: int) -> None:
    for seed in range(20):
        rays = rays_of(np.random.default_rng((91, n, seed)), n)
        found = best_lines(rays, 1, (0.0, 0.0, HEIGHT), NOISE)
        most = max((support(line, rays) for line in all_lines(rays)), default=None)
        if most is None:
            assert len(found) == 0
            continue
        # Weights between two steepnesses are interpolated: 2 % of a score.
        assert support((found[0, 0], found[0, 1]), rays) >= 0.98 * most
        assert found[0, 2] == pytest.approx(support((found[0, 0], found[0, 1]), rays), rel=0.02)


def test_rays_at_one_height_make_no_line() -> None:
    rays = np.column_stack((np.linspace(-1.0, 1.0, 9), np.full(9, 0.2)))
    assert len(best_lines(rays, 3, (0.0, 0.0, HEIGHT), NOISE)) == 0


@pytest.mark.parametrize("n", [0, 1])
def test_fewer_than_two_rays_make_no_line(n: int) -> None:
    assert len(best_lines(np.full((n, 2), 0.1), 3, (0.0, 0.0, HEIGHT), NOISE)) == 0
