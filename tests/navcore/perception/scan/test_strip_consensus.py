"""Our line through trunks has the most points that any line has."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp
from numpy.typing import NDArray

from navcore.errors import ConfigError, ContractError, NotFiniteError
from navcore.perception.scan.strip_consensus import StripConsensus, StripConsensusParams

Floats = NDArray[np.float64]

HALF = 0.15
FIT = StripConsensus(StripConsensusParams(half_width=HALF))
ROUNDING_M = 1e-6
# Whole millimetres over a few metres; not all in one place.
few = hnp.arrays(np.int64, st.tuples(st.integers(2, 7), st.just(2)), elements=st.integers(-1500, 1500))
many = hnp.arrays(np.int64, st.tuples(st.integers(2, 25), st.just(2)), elements=st.integers(-1500, 1500))


def width(points: Floats) -> float:
    """Of the narrowest strip that holds all the points: one of its edges goes through two of them."""
    widths = [math.inf]
    for a, b in itertools.combinations(points, 2):
        d = b - a
        if np.any(d):
            widths.append(float(np.ptp(points @ (-d[1], d[0])) / math.hypot(*d)))
    return min(widths)


def most_by_trying_all_subsets(points: Floats, half: float) -> int:
    """The size of the largest subset that fits into a strip: brute force."""
    for size in range(len(points), 1, -1):
        for chosen in itertools.combinations(range(len(points)), size):
            subset = points[list(chosen)]
            if (subset == subset[0]).all() or width(subset) <= 2.0 * half:
                return size
    return 1


def fitted(points: Floats) -> tuple[int, float]:
    """How many points are within the half width of our line, and the mean square of all distances, m^2."""
    found = FIT.fit(points, np.ones(len(points)))
    assert found is not None
    off = np.abs(found.line.distances(points))
    assert off[found.inliers].max() <= HALF + ROUNDING_M
    return int(np.sum(off <= HALF + ROUNDING_M)), float(np.mean(off**2))


@given(few)
@settings(max_examples=150, deadline=None)
def test_no_subset_of_the_points_fits_a_strip_better(cells: NDArray[np.int64]) -> None:
    points = cells / 1000.0
    if (points == points[0]).all():
        return
    # A millionth of a metre: subsets whose width is that of the strip are decided by rounding.
    assert most_by_trying_all_subsets(points, HALF - ROUNDING_M) <= fitted(points)[0]
    assert fitted(points)[0] <= most_by_trying_all_subsets(points, HALF + 2 * ROUNDING_M)


@given(many, st.floats(-math.pi, math.pi), st.floats(-3.0, 3.0))
@settings(max_examples=100, deadline=None)
def test_no_other_line_has_more_points(cells: NDArray[np.int64], heading: float, offset: float) -> None:
    points = cells / 1000.0
    if (points == points[0]).all():
        return
    off = np.abs(points @ (-math.sin(heading), math.cos(heading)) - offset)
    assert fitted(points)[0] >= np.sum(off <= HALF)


def test_of_lines_with_as_many_points_it_is_the_one_of_least_squares() -> None:
    """Ten rows of trees: a fine search of lines finds none with as many points and less scatter."""
    for seed in range(10):
        rng = np.random.default_rng(seed)
        points = np.column_stack((rng.uniform(0, 20, 22), rng.normal(1.2, 0.1, 22)))
        count, square = fitted(points)
        slope, offset = np.meshgrid(np.linspace(-0.03, 0.03, 241), np.linspace(0.9, 1.5, 241))
        off = np.abs(points[:, 1, None, None] - slope * points[:, 0, None, None] - offset) * np.cos(np.arctan(slope))
        as_many = np.sum(off <= HALF, axis=0) >= count
        # 2 % of the mean square: points beyond 0.30 m are cut off in ours.
        assert not as_many.any() or square <= 1.02 * np.mean(off**2, axis=0)[as_many].min()


def test_weeds_do_not_move_the_line() -> None:
    rng = np.random.default_rng(4)
    trees = np.column_stack((np.arange(12.0), rng.normal(0.0, 0.03, 12)))
    weeds = np.column_stack((rng.uniform(0, 12, 6), rng.uniform(0.5, 2.0, 6)))
    found = FIT.fit(np.vstack((weeds, trees)), np.ones(18))
    assert found is not None
    assert found.inliers.tolist() == [False] * 6 + [True] * 12
    assert abs(found.line.heading) < 0.01  # rad
    assert abs(found.line.offset) < 0.03  # m


def test_a_row_that_runs_across_is_a_line_like_any() -> None:
    found = FIT.fit(np.array([[1.0, -2.0], [1.1, 0.0], [1.0, 2.0], [3.0, 0.0]]), np.ones(4))
    assert found is not None
    assert found.inliers.tolist() == [True, True, True, False]


def test_one_place_or_none_makes_no_line() -> None:
    assert FIT.fit(np.empty((0, 2)), np.empty(0)) is None
    assert FIT.fit(np.ones((4, 2)), np.ones(4)) is None
    few_points = StripConsensus(StripConsensusParams(min_points=4))
    assert few_points.fit(np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), np.ones(3)) is None


def test_what_is_no_number_is_refused() -> None:
    with pytest.raises(NotFiniteError, match="leave those"):
        FIT.fit(np.array([[0.0, math.nan], [1.0, 0.0]]), np.ones(2))
    with pytest.raises(ContractError, match="as many confidences"):
        FIT.fit(np.zeros((2, 2)), np.ones(3))
    with pytest.raises(ConfigError, match="half width"):
        StripConsensusParams(half_width=math.nan)
