"""What looks at a row tell: no more than its plants do, and what the gyro does wrong."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.localization.row_filter import RowFilter, RowFilterParams, look_noise

SPEED, TICK_S = 0.6, 0.1
LOOK = look_noise(0.035, math.radians(0.5), -0.7)
NOTHING_NEW = np.zeros(2)


def in_a_row() -> RowFilter:
    row = RowFilter(RowFilterParams())
    row.unsure(0.45, 0.03)
    return row


def drive_row(row: RowFilter, metres: float, bias: float = 0.0) -> float:
    """Along a row seen as it is, by a gyro that tells `bias` rad/s too little; the direction's error at its end."""
    error = np.zeros(2)
    for _ in range(round(metres / (SPEED * TICK_S))):
        turned = row.drive(SPEED * TICK_S, TICK_S)
        error += (error[1] * SPEED * TICK_S, turned - bias * TICK_S)
        error += row.look(-error, LOOK, inside=True)
    return float(error[1])


def test_a_hundred_pictures_of_the_same_plants_tell_no_more_than_the_first() -> None:
    row = in_a_row()
    row.drive(3.0, 5.0)
    row.look(NOTHING_NEW, LOOK, inside=True)
    once = row.covariance.copy()
    for _ in range(100):
        row.look(NOTHING_NEW, LOOK, inside=True)
    assert row.covariance == pytest.approx(once, rel=1e-3)


def test_a_long_row_tells_what_the_gyro_turns_too_little() -> None:
    row, bias = in_a_row(), math.radians(0.012)
    error = drive_row(row, 60.0, bias)
    assert row.turn_rate == pytest.approx(bias, abs=math.radians(0.004))  # rad/s
    assert abs(error) < math.radians(0.1)


def test_what_the_gyro_turns_too_little_is_kept_over_the_headland() -> None:
    row = in_a_row()
    drive_row(row, 60.0, math.radians(0.012))
    rate = row.turn_rate
    row.unsure(0.2, 0.03)
    assert row.drive(6.0, 10.0) == pytest.approx(10.0 * rate)


def test_a_gyro_measured_at_rest_needs_no_more_of_it() -> None:
    row = in_a_row()
    drive_row(row, 60.0, math.radians(0.012))
    row.new_gyro()
    assert row.drive(6.0, 10.0) == 0.0


def test_a_row_along_a_hill_tells_how_far_the_robot_creeps_down() -> None:
    """0.3 m per metre and unit of slope, on 4 deg, its left side up."""
    row, slope, believed, error = in_a_row(), math.sin(math.radians(4.0)), 0.0, np.zeros(2)
    for _ in range(round(60.0 / (SPEED * TICK_S))):
        row.drive(SPEED * TICK_S, TICK_S, slope)
        error += ((0.3 - believed) * slope * SPEED * TICK_S + error[1] * SPEED * TICK_S, 0.0)
        error += row.look(-error, LOOK, inside=True)
        believed += row.take_creep()
    assert believed == pytest.approx(0.3, abs=0.1)


def test_the_last_plants_do_not_undo_what_a_long_row_told_of_its_direction() -> None:
    """Two or three plants are left and tell 2 deg wrong, over 2 m."""
    row, turned = in_a_row(), 0.0
    drive_row(row, 40.0)
    few = look_noise(0.05, math.radians(1.3), -0.7)
    for _ in range(30):
        row.drive(2.0 / 30, 0.1)
        turned += row.look(np.array((0.0, math.radians(2.0) - turned)), few, inside=True)[1]
    assert turned < math.radians(0.5)


def test_from_outside_a_row_that_was_taken_for_elsewhere_is_put_right_within_a_second() -> None:
    row, across = in_a_row(), 0.0
    for seen in (0.5,) * 20 + (0.0,) * 30:
        row.drive(SPEED * TICK_S, TICK_S)
        across += row.look(np.array((seen - across, 0.0)), LOOK, inside=False)[0]
    assert abs(across) < 0.05  # m


def test_a_direction_in_doubt_becomes_doubt_across_the_row() -> None:
    row = in_a_row()
    row.look(NOTHING_NEW, LOOK, inside=True)
    before, direction = row.covariance[0, 0], row.covariance[1, 1]
    row.drive(10.0, 16.0)
    assert row.covariance[0, 0] > before + 0.5 * 10.0**2 * direction


@given(st.lists(st.tuples(st.floats(0.0, 2.0), st.floats(0.0, 3.0), st.booleans()), max_size=30))
def test_the_covariance_stays_one(way: list[tuple[float, float, bool]]) -> None:
    row = in_a_row()
    for distance, dt, inside in way:
        row.drive(distance, dt)
        row.look(NOTHING_NEW, LOOK, inside=inside)
        assert is_covariance(row.covariance)


def is_covariance(matrix: NDArray[np.float64]) -> bool:
    scale = np.sqrt(np.diag(matrix))
    correlation = matrix / np.outer(scale, scale)
    return bool(np.allclose(matrix, matrix.T, rtol=1e-6) and np.linalg.eigvalsh(correlation)[0] > -1e-6)
