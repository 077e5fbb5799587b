"""A line of posts goes on where some were not seen, and ends at a headland."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.mapping.trellis.post_lines import upright_lines

Floats = NDArray[np.float64]
VINES_M, ROWS_M, LENGTH_M = 1.2, 2.7, 60.0


def block(rows: int = 6, seed: int = 0, unseen: float = 0.0) -> Floats:
    """Vines as high as posts, some of which nobody saw (P, 2), m."""
    rng = np.random.default_rng(seed)
    along = np.arange(0.0, LENGTH_M, VINES_M)
    places = np.array([(s, k * ROWS_M) for k in range(rows) for s in along])
    return places[rng.random(len(places)) >= unseen] + 0.03 * rng.standard_normal((1, 2))


def without(places: Floats, line: int, begin: float, end: float) -> Floats:
    gone = (np.abs(places[:, 1] - line * ROWS_M) < 0.5) & (places[:, 0] > begin) & (places[:, 0] < end)
    return places[~gone]


def lengths(places: Floats) -> list[float]:
    """Of all lines, m."""
    return [float(np.ptp(places[line][:, 0])) for family in upright_lines(places) for line in family]


def test_a_line_goes_on_behind_vines_that_nobody_saw() -> None:
    for seed in range(5):
        places = block(seed=seed, unseen=0.4)
        places = without(without(places, 0, 20.0, 32.0), 3, 10.0, 17.0)
        found = lengths(places)
        assert len(found) == 6
        assert min(found) > LENGTH_M - 8.0  # m


def test_a_headland_of_six_metres_parts_two_blocks_behind_each_other() -> None:
    near, far = block(), block(seed=1) + np.array((LENGTH_M + 5.0, 0.0))
    found = lengths(np.concatenate((near, far)))
    assert len(found) == 12
    assert max(found) <= LENGTH_M


def test_a_lone_line_ends_at_its_gap() -> None:
    one, beside = block(rows=1), block(rows=1, seed=1) + np.array((0.0, 30.0))
    found = lengths(without(np.concatenate((one, beside)), 0, 20.0, 32.0))
    assert len(found) == 3
