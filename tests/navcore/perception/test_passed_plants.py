"""Plants that the robot has passed tell where the row runs."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.perception.passed_plants import PassedPlants, PassedPlantsParams

Floats = NDArray[np.float64]

STEP = 0.25
EXPECTED = np.array((0.0, 0.0, 3.0, 0.0))
# What is known anyway: nothing of offset and heading, a little of the width.
KNOWN = np.diag((1e-3, 1e-3, 1 / 0.1**2, 1 / 0.02**2))


def passed(metres: float = 20.0, creep: float = 0.0, odd: float = 0.0) -> PassedPlants:
    """Driven along a corridor 3 m wide with a plant every metre; `creep` m aside per metre, which odometry misses.

    One plant stands `odd` m off its line.
    """
    plants, at = PassedPlants(0.4, PassedPlantsParams()), 0.0
    while at < metres:
        plants.move(SE2(STEP, 0.0, 0.0))
        at += STEP
        x = np.arange(math.ceil(at), at + 8.0)
        y = np.where(x == 12.0, 1.5 + odd, 1.5)
        feet = np.vstack(
            (np.column_stack((x - at, y + creep * at)), np.column_stack((x - at, -1.5 + creep * at + 0 * x)))
        )
        plants.see(feet, np.repeat((1, -1), len(x)))
    plants.move(SE2(0.0, 0.0, 0.0))
    return plants


def solved(plants: PassedPlants) -> tuple[Floats, Floats]:
    """Corridor and its 1-sigma by the passed plants alone."""
    more, vector = plants.information(EXPECTED)
    together = KNOWN + more
    return np.linalg.solve(together, KNOWN @ EXPECTED + vector), np.sqrt(np.diag(np.linalg.inv(together)))


def test_plants_out_of_sight_tell_place_and_direction_of_the_row() -> None:
    state, std = solved(passed())
    assert state[:3] == pytest.approx((0.0, 0.0, 3.0), abs=1e-6)
    assert std[0] < 0.05  # m
    assert std[1] < math.radians(0.5)


def test_what_is_in_sight_does_not_count_twice() -> None:
    plants = PassedPlants(0.4, PassedPlantsParams())
    x = np.arange(1.5, 5.0, 0.5)
    feet = np.vstack((np.column_stack((x, 1.5 + 0 * x)), np.column_stack((x, -1.5 + 0 * x))))
    plants.see(feet, np.repeat((1, -1), len(x)))
    more, vector = plants.information(EXPECTED)
    assert not more.any()
    assert not vector.any()


def test_a_few_plants_at_the_entrance_say_nothing() -> None:
    assert not passed(metres=2.0).information(EXPECTED)[0].any()


def test_a_robot_that_creeps_aside_is_not_sure_of_the_direction() -> None:
    """0.3 deg of creep is within what is told."""
    state, std = solved(passed(creep=math.radians(0.3)))
    assert abs(state[1]) < 2.0 * std[1]
    assert std[1] > math.radians(0.2)


def test_a_plant_beside_the_row_is_none_of_it() -> None:
    assert solved(passed(odd=0.9))[0] == pytest.approx(solved(passed())[0], abs=1e-6)


def test_a_turned_robot_still_knows_where_they_stand() -> None:
    plants = passed()
    plants.move(SE2(0.0, 0.0, 0.1))
    more, vector = plants.information(np.array((0.0, -0.1, 3.0, 0.0)))
    state = np.linalg.solve(KNOWN + more, KNOWN @ EXPECTED + vector)
    assert state[1] == pytest.approx(-0.1, abs=0.003)  # rad


def test_another_row_begins_without_them() -> None:
    plants = passed()
    plants.forget()
    assert not plants.information(EXPECTED)[0].any()
