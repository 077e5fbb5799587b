"""The middle between two lines of plants, straight or bending."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.perception.plants.bending_row import BendingRow, Middle

Floats = NDArray[np.float64]
WIDTH = 2.6
AHEAD = np.arange(-9.0, 10.0, 1.4)


def plants(bend: Floats, scatter: float = 0.0, seed: int = 1, std: float = 0.01) -> Floats:
    """(M, 4) on both lines of a corridor along x whose middle is at `bend` (N,) at `AHEAD`, sure ones."""
    rng, n = np.random.default_rng(seed), len(AHEAD)
    y = np.concatenate((bend + WIDTH / 2, bend - WIDTH / 2)) + rng.normal(0.0, scatter, 2 * n)
    return np.column_stack((np.tile(AHEAD, 2), y, np.full(2 * n, std), np.ones(2 * n)))


def fitted(seen: Floats, offset: float = 0.0, heading: float = 0.0) -> Middle:
    found = BendingRow().fit(offset, heading, WIDTH, seen)
    assert found is not None
    return found


@settings(deadline=None)  # machine code is made ready first
@given(st.floats(-0.2, 0.2), st.floats(-0.05, 0.05))
def test_of_a_straight_row_it_tells_offset_and_heading(offset: float, heading: float) -> None:
    """Whatever corridor near by it starts from."""
    line = (offset + AHEAD * math.sin(heading)) / math.cos(heading)
    found = fitted(plants(line))
    assert found.offset == pytest.approx(offset, abs=0.01)  # m
    assert found.heading == pytest.approx(heading, abs=0.006)  # rad
    assert found.width == pytest.approx(WIDTH * math.cos(heading), abs=0.02)  # m


@given(st.floats(-math.pi, math.pi), st.floats(-1.0, 1.0))
def test_the_same_row_in_a_turned_frame_is_the_same(yaw: float, aside: float) -> None:
    seen = plants(0.1 + 0.0 * AHEAD, 0.08)
    plain = fitted(seen)
    moved = seen.copy()
    moved[:, :2] = SE2(0.0, 0.0, yaw).apply(seen[:, :2] + (0.0, aside))
    there = fitted(moved, aside, yaw)
    assert there.offset == pytest.approx(plain.offset + aside * math.cos(plain.heading), abs=1e-6)  # m
    assert math.remainder(there.heading - yaw - plain.heading, 2.0 * math.pi) == pytest.approx(0.0, abs=1e-6)


def test_young_trees_that_stand_10_cm_about_it_leave_its_middle_known_to_a_few() -> None:
    """And the told sigma fits what happens, over 200 plantings."""
    found = [fitted(plants(0.0 * AHEAD, 0.10, seed)) for seed in range(200)]
    off = np.array([f.offset for f in found])
    told = np.sqrt(np.mean([f.covariance[0, 0] for f in found]))
    assert np.sqrt(np.mean(off**2)) < 0.035  # m; a straight line by all would leave 0.019
    assert 0.7 < np.sqrt(np.mean(off**2)) / told < 1.3


def test_a_row_that_shifts_sideways_is_followed_where_a_straight_line_cuts_the_corner() -> None:
    bend = np.interp(AHEAD, (-1.5, 1.5), (-0.175, 0.175))
    seen = [_seen_from(plants(bend, 0.05, seed), 1.5) for seed in range(60)]
    followed = np.array([fitted(p).offset for p in seen])
    straight = np.array([np.polyfit(p[:, 0], p[:, 1], 1)[1] for p in seen])
    assert np.abs(followed - 0.175).mean() < 0.06  # m
    assert np.abs(followed - 0.175).mean() < 0.7 * np.abs(straight - 0.175).mean()


@pytest.mark.parametrize("curvature", [0.012, -0.012])
def test_of_an_even_curve_it_tells_direction_and_curvature(curvature: float) -> None:
    """Away from the middle of what is seen: the row runs askew there."""
    seen = plants(0.5 * curvature * AHEAD**2, 0.01)
    found = fitted(_seen_from(seen, 3.0), offset=0.05)
    assert found.offset == pytest.approx(0.5 * curvature * 9.0, abs=0.02)  # m
    assert found.heading == pytest.approx(3.0 * curvature, abs=0.01)  # rad
    assert found.curvature == pytest.approx(curvature, abs=0.008)  # 1/m


def test_in_the_middle_of_a_shift_the_row_runs_askew_and_at_its_ends_it_bends() -> None:
    bend = np.interp(AHEAD, (-1.5, 1.5), (-0.175, 0.175))
    at = {x: fitted(_seen_from(plants(bend, 0.01), x), heading=0.05) for x in (-1.5, 0.0, 1.5)}
    assert at[0.0].heading == pytest.approx(0.117, abs=0.02)  # rad: 0.35 m over 3 m
    assert abs(at[0.0].curvature) < 0.02  # 1/m
    assert at[-1.5].curvature > 0.03
    assert at[1.5].curvature < -0.03


def test_the_next_lines_on_either_side_tell_how_the_row_bends() -> None:
    """Each somewhere near one width further out, and a little askew."""
    bend = np.interp(AHEAD, (-1.5, 1.5), (-0.175, 0.175))
    alone, together = [], []
    for seed in range(60):
        seen, beyond = plants(bend, 0.10, seed), plants(bend, 0.10, 1000 + seed)
        out = np.sign(beyond[:, 1]) * (WIDTH + 0.08) + 0.005 * beyond[:, 0]
        more = np.vstack((seen, beyond + np.column_stack((0.0 * out, out, 0.0 * out, 0.0 * out))))
        alone.append(fitted(_seen_from(seen, 1.5)).offset)
        together.append(fitted(_seen_from(more, 1.5)).offset)
    off, less = (np.abs(np.array(found) - 0.175).mean() for found in (alone, together))
    assert less < 0.85 * off


def test_a_next_line_that_stands_further_out_moves_the_middle_by_less_than_a_centimetre() -> None:
    seen = plants(0.0 * AHEAD, 0.05)
    beyond = plants(0.0 * AHEAD + WIDTH + 0.2, 0.05, 7)[: len(AHEAD)]
    assert fitted(np.vstack((seen, beyond))).offset == pytest.approx(fitted(seen).offset, abs=0.01)  # m


def test_an_upright_that_may_be_a_weed_tells_nothing_of_the_next_line() -> None:
    seen, beyond = plants(0.0 * AHEAD, 0.05), plants(0.0 * AHEAD + WIDTH, 0.15, 7)[: len(AHEAD)]
    beyond[:, 3] = 0.6
    assert fitted(np.vstack((seen, beyond))).offset == pytest.approx(fitted(seen).offset, abs=1e-12)


def _seen_from(seen: Floats, along: float) -> Floats:
    return seen - (along, 0.0, 0.0, 0.0)


def test_uprights_that_no_picture_has_shown_hardly_move_a_middle_that_sure_plants_tell() -> None:
    """Half of them stand 20 cm to the left, where weeds grow."""
    row = plants(0.0 * AHEAD, 0.05)
    weeds = plants(0.2 + 0.0 * AHEAD, 0.05, seed=2)
    weeds[:, 0], weeds[:, 3] = weeds[:, 0] + 0.7, 0.6
    assert abs(fitted(np.vstack((row, weeds))).offset - fitted(row).offset) < 0.03  # m; as sure as told it is 0.08


def test_where_no_picture_has_shown_any_the_uprights_tell_the_middle_all_the_same() -> None:
    unsure = plants(0.1 + 0.0 * AHEAD, 0.05)
    unsure[:, 3] = 0.6
    assert fitted(unsure).offset == pytest.approx(0.1, abs=0.05)  # m


def test_with_one_plant_on_a_side_there_is_nothing_to_add() -> None:
    seen = plants(0.0 * AHEAD)
    assert BendingRow().fit(0.0, 0.0, WIDTH, seen[: len(AHEAD) + 1]) is None
    assert BendingRow().fit(0.0, 0.0, WIDTH, np.empty((0, 4))) is None


def test_what_stands_in_the_alley_is_none_of_its_lines() -> None:
    seen = plants(0.0 * AHEAD)
    in_the_way = np.array([(2.0, 0.3, 0.01, 1.0), (3.0, -0.2, 0.01, 1.0)])
    assert fitted(np.vstack((seen, in_the_way))).offset == pytest.approx(fitted(seen).offset, abs=1e-12)
