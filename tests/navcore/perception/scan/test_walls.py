"""Walls come back as long, as straight and where they are; what is round or short is none."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.perception.scan.cloud_ring import cloud_ring
from navcore.perception.scan.walls import WallParams, walls

Floats = NDArray[np.float64]
ANGLES = np.radians(np.arange(0.0, 360.0, 0.225))


def room(turned: float, noise: float = 0.0, seed: int = 0) -> Floats:
    """Distances (N,) along `ANGLES` in a room of 5 m by 3 m, from 1 m off its middle, turned by `turned` rad."""
    c, s = np.cos(ANGLES - turned), np.sin(ANGLES - turned)
    with np.errstate(divide="ignore", over="ignore"):
        to_x = np.where(c > 0.0, 1.5, 3.5) / np.abs(c)
        to_y = np.where(s > 0.0, 1.2, 1.8) / np.abs(s)
    return np.asarray(np.minimum(to_x, to_y) + np.random.default_rng(seed).normal(0.0, noise, len(ANGLES)))


@settings(deadline=None, max_examples=100)
@given(st.floats(-math.pi, math.pi))
def test_a_room_has_four_walls_however_the_sensor_is_turned(turned: float) -> None:
    """One of them, or a corner, lies where the turn begins."""
    found = walls(ANGLES, room(turned, noise=0.004))
    assert len(found) == 4
    assert [wall.length for wall in found] == pytest.approx([5.0, 5.0, 3.0, 3.0], abs=0.1)  # m
    assert max(wall.rms for wall in found) < 0.006  # m


def test_the_order_of_the_rays_is_no_matter() -> None:
    """RPLIDARs turn clockwise."""
    there, back = walls(ANGLES, room(0.3)), walls(ANGLES[::-1], room(0.3)[::-1])
    assert there == back


def test_walls_lie_where_they_stand() -> None:
    (x0, y0), (x1, y1) = walls(ANGLES, room(0.0))[0].ends
    assert sorted((x0, x1)) == pytest.approx([-3.5, 1.5], abs=0.03)
    assert {round(abs(y0), 2), round(abs(y1), 2)} <= {1.2, 1.8}


def test_a_round_tank_is_no_wall() -> None:
    about = np.arcsin(np.clip(3.0 * np.sin(ANGLES), -1.0, 1.0))  # seen from 3 m, 1 m thick
    facing = np.abs(np.mod(ANGLES + math.pi, math.tau) - math.pi) < math.asin(1.0 / 3.0)
    distances = np.where(facing, 3.0 * np.cos(ANGLES) - np.cos(about), 0.0)
    assert walls(ANGLES, distances, WallParams(corner=0.01)) == ()


@pytest.mark.parametrize("back", [0, 1, 3])
def test_a_scan_of_next_to_nothing_has_no_walls(back: int) -> None:
    distances = np.zeros(len(ANGLES))
    distances[:back] = 2.0
    assert walls(ANGLES, distances) == ()


def test_a_ring_is_what_a_level_sensor_would_have_met() -> None:
    """A pole of a cloud at all heights, and ground that only a lower ring meets."""
    z = np.arange(-1.0, 1.0, 0.01)
    pole = np.column_stack((np.full(len(z), -4.0), np.full(len(z), 3.0), z))
    ground = np.column_stack((np.linspace(2.0, 9.0, 50), np.zeros(50), np.full(50, -1.0)))
    bearings, distances = cloud_ring(np.vstack((pole, ground)), 0.0)
    assert len(bearings) > 3
    assert bearings == pytest.approx(math.atan2(3.0, -4.0))
    assert distances == pytest.approx(5.0)
