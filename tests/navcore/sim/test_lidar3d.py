"""The simulated 3D LiDAR as a device: its beams, its time, its noise and its faults, the same bits for a seed."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.errors import ContractError, InputError, NotFiniteError
from navcore.geometry.se3 import SE3
from navcore.sim.lidar3d import C16, VLP16, Lidar3d, Lidar3dFaults, Lidar3dParams
from navcore.sim.rays.land_scene import Part
from tests.navcore.sim.lidar3d_turns import (
    MOUNT,
    S,
    level,
    on_robot,
    pole,
    scene,
    seen,
    turn,
    wall,
)


def test_sixteen_beams_two_degrees_apart_look_at_1800_azimuths() -> None:
    told = turn(scene(*(wall(x) for x in (7.0, -7.0))))
    x, y, z = told.cloud.points.T
    elevation_deg = np.degrees(np.arctan2(z, np.hypot(x, y)))
    assert np.abs(elevation_deg - (-15.0 + 2.0 * told.cloud.rings)).max() < 1e-9
    azimuths = np.unique(np.round(np.degrees(np.arctan2(y, x)) * 5.0, 3))
    assert np.abs(azimuths - np.rint(azimuths)).max() < 1e-3, "every 0.2 degrees"
    assert set(told.cloud.rings.tolist()) == set(range(16))


def test_a_real_sensor_places_a_post_within_its_noise() -> None:
    what, means = scene(pole(5.0, 1.0)), []
    for k in range(20):
        told = turn(what, C16, stamp_ns=S + k)
        off = on_robot(told)[seen(told, Part.POST)] - (5.0, 1.0, 0.0)
        ray = np.array((4.8, 1.0)) / math.hypot(4.8, 1.0)
        means.append(off[:, :2] @ ray)
    errors = np.concatenate(means)
    assert errors.mean() == pytest.approx(-0.04, abs=0.01)  # m: the near side of a post of 5 cm
    assert errors.std() == pytest.approx(0.022, abs=0.006)  # m: 2 cm of noise, 5 mm of each beam's own, its roundness


def test_a_driving_robot_measures_each_point_from_where_it_is_then() -> None:
    told = turn(scene(wall(8.0)), begin=SE3.identity(), end=SE3.from_rpy((0.15, 0.0, 0.0)))
    x = on_robot(told)[:, 0] + 0.15 * (1.0 + told.cloud.times / 0.1)
    assert np.abs(x - 8.0)[seen(told, Part.WALL)].max() < 2e-4  # m


def test_a_turning_robot_sees_a_post_turned_by_what_it_turned_until_then() -> None:
    told = turn(scene(pole(6.0, 2.0)), begin=SE3.from_rpy((0.0, 0.0, 0.0), yaw=-0.1), end=SE3.identity())
    post = seen(told, Part.POST)
    yaw = told.cloud.times[post] / 0.1 * 0.1
    x, y = on_robot(told)[post, 0], on_robot(told)[post, 1]
    turned = np.column_stack((np.cos(yaw) * x - np.sin(yaw) * y, np.sin(yaw) * x + np.cos(yaw) * y))
    assert np.abs(np.hypot(turned[:, 0] - 6.0, turned[:, 1] - 2.0) - 0.05).max() < 4e-4  # m: one column is one pose
    assert np.hypot(*(np.column_stack((x, y)) - (6.0, 2.0)).T).min() > 0.15  # m: 0.05 rad at 6 m, uncorrected


def test_points_come_in_the_order_in_which_they_were_taken_within_one_turn() -> None:
    told = turn(scene(wall(7.0), wall(-7.0)))
    assert (np.diff(told.cloud.times) > 0.0).all()
    assert -0.1 < told.cloud.times[0] < -0.0999
    assert told.cloud.times[-1] == pytest.approx(0.0, abs=1e-12)
    first, last = told.cloud.points[0], told.cloud.points[-1]
    assert first[0] < 0.0, "a turn begins behind the robot"
    assert last[0] < 0.0, "and ends there"


def test_the_same_seed_and_stamp_give_the_same_bits_and_another_stamp_others() -> None:
    what = scene(wall(7.0), pole(3.0, 1.0), ground=level(grass=0.1))
    one, same, other = turn(what, C16), turn(what, C16), turn(what, C16, stamp_ns=2 * S)
    assert one.cloud.points.tobytes() == same.cloud.points.tobytes()
    assert one.cloud.intensities.tobytes() == same.cloud.intensities.tobytes()
    assert one.cloud.points.tobytes() != other.cloud.points.tobytes()
    assert turn(what, C16, seed=2).cloud.points.tobytes() != one.cloud.points.tobytes()


def test_dark_things_far_away_are_often_lost_and_nothing_is_told_beyond_the_range() -> None:
    near, far = (turn(scene(wall(x, Part.TRUNK)), C16) for x in (10.0, 80.0))
    rates = [
        seen(t, Part.TRUNK)[(t.cloud.rings > 7) & (np.abs(t.cloud.points[:, 1]) < 5.0)].sum() for t in (near, far)
    ]
    wanted = [8 * 2 * math.degrees(math.atan2(5.0, x)) / 0.2 for x in (9.8, 79.8)]
    assert rates[0] / wanted[0] > 0.95
    assert 0.3 < rates[1] / wanted[1] < 0.8
    assert not seen(turn(scene(wall(101.0)), C16), Part.WALL).any()


def test_the_faults_are_an_empty_scan_rain_and_a_knocked_mount() -> None:
    what = scene(wall(7.0))
    assert len(turn(what, C16, faults=Lidar3dFaults(empty=True)).cloud) == 0
    rainy = turn(what, C16, faults=Lidar3dFaults(rain=0.2))
    drops = seen(rainy, Part.MIXED) & (np.linalg.norm(rainy.cloud.points, axis=1) < 6.0)
    assert drops.mean() > 0.15
    knocked = turn(what, faults=Lidar3dFaults(turned=(0.0, math.radians(5.0), 0.0)))
    ahead = np.abs(knocked.cloud.points[:, 1]) < 0.5
    met = knocked.cloud.points[ahead & seen(knocked, Part.WALL)]
    slope = float(np.polyfit(met[:, 2], met[:, 0], 1)[0])
    assert math.degrees(math.atan(slope)) == pytest.approx(-5.0, abs=0.1)


def test_velodyne_and_leishen_differ_in_time_and_resolution() -> None:
    what = scene(wall(7.0))
    for params, step, beam_s in ((C16, 0.0025, 3.125e-6), (VLP16, 0.002, 2.304e-6)):
        cloud = turn(what, params).cloud
        d = np.linalg.norm(cloud.points, axis=1) / step
        assert np.abs(d - np.rint(d)).max() < 1e-6
        gaps = np.diff(cloud.times)
        assert gaps.min() == pytest.approx(beam_s, rel=1e-6)


def test_impossible_sensors_and_poses_are_refused() -> None:
    for wrong in ({"columns": 10}, {"noise": -1.0}, {"noise": math.nan}, {"elevations_deg": (0.0, 50.0, 1.0, 2.0)}):
        with pytest.raises(InputError):
            Lidar3dParams(**wrong)
    lidar = Lidar3d(scene(wall(7.0)), MOUNT, C16, 1)
    with pytest.raises(ContractError, match="reach from the begin"):
        lidar.turn(S, (S - S // 20, S), (SE3.identity(), SE3.identity()))
    with pytest.raises(ContractError, match="rising"):
        lidar.turn(S, (S, S - S // 5), (SE3.identity(), SE3.identity()))
    with pytest.raises(NotFiniteError):
        lidar.turn(S, (0, S), (SE3.identity(), SE3.from_rpy((math.nan, 0.0, 0.0))))
