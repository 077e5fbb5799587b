"""The pattern of the trunks tells where along the row the robot is, or says that it cannot."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.localization.trunk_match import TrunkShift, match_trunks

Floats = NDArray[np.float64]
SEEDS = st.integers(0, 10_000)


def trunks(rng: np.random.Generator, scatter: float) -> Floats:
    """Two lines of 40 trunks, 1.2 m apart and scattered, 2.5 m between the lines."""
    along = np.tile(np.arange(40) * 1.2, 2)
    side = np.repeat((1.0, -1.0), 40)
    x = along + rng.normal(0.0, scatter, 80)
    y = side * 1.25 + rng.normal(0.0, 0.3 * scatter, 80)
    return np.column_stack((x, y, side, np.full(80, 0.03)))


def sight(known: Floats, at: float, shift: float, rng: np.random.Generator) -> Floats:
    """What stands 0 to 8 m ahead of `at`, seen to 1 cm, by who believes to be `shift` m further back."""
    seen = known[(known[:, 0] > at) & (known[:, 0] < at + 8.0), :3].copy()
    seen[:, :2] += rng.normal(0.0, 0.01, (len(seen), 2))
    seen[:, 0] -= shift
    return seen


@given(seed=SEEDS, at=st.floats(0.0, 35.0), shift=st.floats(-1.5, 1.5))
def test_true_shift_is_found_where_spacings_are_scattered(seed: int, at: float, shift: float) -> None:
    rng = np.random.default_rng(seed)
    known = trunks(rng, 0.15)
    found = match_trunks(sight(known, at, shift, rng), known, 0.8)
    assert isinstance(found, TrunkShift), found
    assert found.shift == pytest.approx(shift, abs=0.03)  # m


@given(seed=SEEDS, at=st.floats(5.0, 30.0), shift=st.floats(-0.5, 0.5))
def test_an_even_row_is_ambiguous_for_who_is_unsure(seed: int, at: float, shift: float) -> None:
    rng = np.random.default_rng(seed)
    known = trunks(rng, 0.0)
    assert match_trunks(sight(known, at, shift, rng), known, 0.8) == "ambiguous"


@given(seed=SEEDS, at=st.floats(5.0, 30.0), shift=st.floats(-0.2, 0.2))
def test_an_even_row_tells_the_place_to_who_knows_it_nearly(seed: int, at: float, shift: float) -> None:
    rng = np.random.default_rng(seed)
    known = trunks(rng, 0.0)
    found = match_trunks(sight(known, at, shift, rng), known, 0.15)
    assert isinstance(found, TrunkShift), found
    assert found.shift == pytest.approx(shift, abs=0.03)  # m


@given(seed=SEEDS, at=st.floats(5.0, 30.0), shift=st.floats(-1.2, 1.2))
def test_missing_and_new_trunks_do_not_mislead(seed: int, at: float, shift: float) -> None:
    rng = np.random.default_rng(seed)
    stands = trunks(rng, 0.15)
    known = stands[rng.random(80) > 0.1]
    found = match_trunks(sight(stands[rng.random(80) > 0.1], at, shift, rng), known, 0.8)
    assert isinstance(found, str) or found.shift == pytest.approx(shift, abs=0.04)  # m


def test_too_few_trunks_say_nothing() -> None:
    known = trunks(np.random.default_rng(1), 0.15)
    assert match_trunks(known[:3, :3], known, 0.8) == "only 3 trunks are seen"


def test_trunks_that_stand_anyhow_are_seldom_taken_for_the_known_ones() -> None:
    rng = np.random.default_rng(2)
    known = trunks(rng, 0.15)
    anyhow = [np.column_stack((rng.uniform(0.0, 45.0, 80), known[:, 1:])) for _ in range(100)]
    found = [match_trunks(sight(other, 10.0, 0.0, rng), known, 0.8) for other in anyhow]
    assert sum(isinstance(answer, TrunkShift) for answer in found) <= 2


def test_without_known_trunks_nothing_is_matched() -> None:
    rng = np.random.default_rng(3)
    known = trunks(rng, 0.15)
    assert isinstance(match_trunks(sight(known, 10.0, 0.0, rng), known[:0], 0.8), str)
