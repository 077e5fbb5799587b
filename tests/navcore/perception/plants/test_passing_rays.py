"""Rays that end beyond where an upright should stand say that none is there."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2
from navcore.perception.plants.passing_rays import share_past
from tests.navcore.perception.scan.round_trunks import RAYS, scan_of

MOUNT = LidarMount(x=0.3, y=0.0, z=0.55)
PLACE = np.array(((3.0, 1.0),))
DIAMETER = np.array((0.1,))
MARGIN = 0.15


def seen(
    places: NDArray[np.float64], diameters: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """One turn of a LiDAR that stands in `MOUNT`, at things in `base_link`."""
    return scan_of(places - (MOUNT.x, MOUNT.y), diameters)


def past(angles: NDArray[np.float64], distances: NDArray[np.float64], turn: SE2 = SE2()) -> float:
    return float(share_past(PLACE, DIAMETER, angles, distances, MOUNT, turn, MARGIN)[0])


def test_no_ray_passes_a_trunk_that_stands_there() -> None:
    assert past(*seen(PLACE, DIAMETER)) == 0.0


def test_all_rays_pass_a_place_where_nothing_stands_before_a_wall_or_open_land() -> None:
    wall, beside = np.array(((4.5, 1.5),)), np.array(((3.0, 1.4),))
    assert past(*seen(wall, np.array((1.0,)))) == 1.0
    assert past(*seen(beside, DIAMETER)) == 1.0


def test_where_no_ray_comes_back_at_all_the_sensor_may_be_covered_and_passes_nothing() -> None:
    far_aside = np.array(((3.0, -1.0),))
    assert past(*seen(far_aside, DIAMETER)) == 0.0
    assert past(*seen(np.empty((0, 2)), np.empty(0))) == 0.0


def test_a_ray_that_ends_before_the_place_does_not_say_what_stands_there() -> None:
    assert past(*seen(np.array(((1.6, 0.48),)), np.array((0.3,)))) == 0.0


def test_where_the_sensor_took_no_rays_nothing_is_known() -> None:
    angles, distances = seen(np.array(((4.5, 1.5),)), np.array((1.0,)))
    bearing = math.atan2(1.0, 2.7)
    elsewhere = np.abs(np.remainder(angles - bearing + math.pi, 2.0 * math.pi) - math.pi) > 0.3
    assert past(angles[elsewhere], distances[elsewhere]) == 0.0
    assert past(np.empty(0), np.empty(0)) == 0.0


def test_a_place_is_looked_at_from_where_the_robot_was_when_its_rays_were_taken() -> None:
    """0.3 m while the sensor turned, of which it had most before it when it met the trunk on the right."""
    turn, place = SE2(0.3, 0.0, 0.0), np.array(((1.0, -1.2),))
    angles, distances = np.zeros(RAYS), np.zeros(RAYS)
    for i in range(RAYS):
        if i % 40 == 0:
            moved = 0.3 * (1.0 - i / RAYS)
            angles, whole = seen(place + np.array((moved, 0.0)), DIAMETER)
        distances[i] = whole[i]
    with_turn, without = (
        share_past(place, DIAMETER, angles, distances, MOUNT, t, MARGIN)[0] for t in (turn, SE2())
    )  # fmt: skip
    assert with_turn == 0.0
    assert without == 1.0


def test_a_sensor_that_hangs_upside_down_sees_the_same() -> None:
    hanging = LidarMount(x=0.3, y=0.0, z=0.55, roll=math.pi)
    trunk_and_wall = np.array(((3.0, 1.0), (4.5, -1.5)))
    angles, distances = scan_of((trunk_and_wall - (0.3, 0.0)) * (1.0, -1.0), np.array((0.1, 1.0)))
    assert share_past(PLACE, DIAMETER, angles, distances, hanging, SE2(), MARGIN)[0] == 0.0
    assert share_past(PLACE * (1.0, -1.0), DIAMETER, angles, distances, hanging, SE2(), MARGIN)[0] == 1.0


def test_no_uprights_are_no_trouble() -> None:
    angles, distances = seen(PLACE, DIAMETER)
    none = share_past(np.empty((0, 2)), np.empty(0), angles, distances, MOUNT, SE2(), MARGIN)
    assert none.shape == (0,)
