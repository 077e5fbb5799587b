"""A scan laid over the plants that are known: the pose at which it fits."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.perception.plants.alignment_kernels import mutual_nearest
from navcore.perception.plants.scan_alignment import ScanAlignmentParams, align

Floats = NDArray[np.float64]
KNOWN = np.array(
    [(x, side * 1.3 + 0.1 * math.sin(3.0 * x)) for x in np.arange(0.3, 9.0, 1.4) for side in (1.0, -1.0)]
)


def laid(seen: Floats, predicted: SE2, moved: SE2 = SE2(0.1, 0.0, 0.0)) -> SE2:
    std = np.full(len(seen), 0.01)
    return align(predicted, moved, seen, std, KNOWN, np.full(len(KNOWN), 0.01), ScanAlignmentParams())


@settings(deadline=None)
@given(st.floats(-0.06, 0.06), st.floats(-0.06, 0.06), st.floats(-0.01, 0.01), st.floats(-math.pi, math.pi))
def test_what_the_wheels_got_wrong_between_two_scans_the_trunks_put_right(
    dx: float, dy: float, turn: float, yaw: float
) -> None:
    """Wherever the tracker's frame happens to lie."""
    world, true = SE2(0.0, 0.0, yaw), SE2(0.4, 0.05, 0.02)
    seen = true.inverse().apply(KNOWN)
    std, moved = np.full(len(KNOWN), 0.01), SE2(0.2, 0.0, 0.02)
    predicted = world @ SE2(true.x + dx, true.y + dy, true.yaw + turn)
    found = align(predicted, moved, seen, std, world.apply(KNOWN), std, ScanAlignmentParams())
    error = (world @ true).inverse() @ found
    assert (error.x, error.y) == pytest.approx((0.0, 0.0), abs=0.01)  # m
    assert error.yaw == pytest.approx(0.0, abs=0.003)  # rad


def test_where_nothing_is_seen_or_known_odometry_is_believed() -> None:
    predicted = SE2(0.3, -0.1, 0.02)
    assert laid(np.empty((0, 2)), predicted) == predicted
    apart = laid(SE2(50.0, 0.0, 0.0).apply(KNOWN), predicted)
    assert (apart.x, apart.y, apart.yaw) == pytest.approx((predicted.x, predicted.y, predicted.yaw))


@given(st.integers(0, 12), st.integers(0, 12), st.integers(0, 10_000))
def test_pairs_are_each_others_nearest_and_within_the_gate(n: int, m: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    seen, known = rng.uniform(-1.0, 1.0, (n, 2)), rng.uniform(-1.0, 1.0, (m, 2))
    mine, theirs = mutual_nearest(seen, known, 0.4)
    apart = np.linalg.norm(seen[:, None] - known[None], axis=2)
    expected = [
        (i, j) for i in range(n) for j in range(m)
        if apart[i, j] <= 0.4 and apart[i, j] == apart[i].min() == apart[:, j].min()
    ]  # fmt: skip
    assert list(zip(mine.tolist(), theirs.tolist(), strict=True)) == expected
