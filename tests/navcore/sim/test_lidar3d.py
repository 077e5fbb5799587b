"""The simulated 3D LiDAR: true to geometry, noisy as told, blind behind what is solid, the same bits for a seed."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.errors import ContractError, InputError, NotFiniteError
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se3 import SE3
from navcore.sim.lidar3d import C16, FLAWLESS_3D, VLP16, Lidar3d, Lidar3dFaults, Lidar3dParams, SimTurn
from navcore.sim.rays.ground import Ground
from navcore.sim.rays.land_scene import LandScene, Part
from navcore.sim.trellis.shapes import Shapes, bunches, panels, rods, scene_of

Floats = NDArray[np.float64]
MOUNT = LidarMount(x=0.2, y=0.0, z=0.6)
S = 1_000_000_000
ROUNDED_M = 6e-5
"""Half the resolution of a flawless sensor."""


def level(height: float = 0.0, grass: float = 0.0) -> Ground:
    soil = np.full((3, 3), height, np.float32)
    return Ground(-500.0, -500.0, 1.0 / 500.0, 0.05, soil, soil + np.float32(grass))


def wall(x: float, part: Part = Part.WALL, top: float = 30.0) -> Shapes:
    """Across the x axis, 400 m wide."""
    corners = [(x, -200.0, -1.0), (x, 200.0, -1.0), (x, 200.0, top), (x, -200.0, top)]
    return panels(np.array([corners]), part)


def pole(x: float, y: float, radius: float = 0.05, part: Part = Part.POST) -> Shapes:
    return rods(np.array([(x, y, -0.1)]), np.array([(x, y, 3.0)]), np.array([radius]), np.array([radius]), part)


def scene(*pieces: Shapes, ground: Ground | None = None) -> LandScene:
    return scene_of(list(pieces), ground or level(), 0.15)


def turn(
    what: LandScene, params: Lidar3dParams = FLAWLESS_3D, *, begin: SE3 | None = None, end: SE3 | None = None,
    seed: int = 1, stamp_ns: int = S, faults: Lidar3dFaults | None = None, mount: LidarMount = MOUNT,
) -> SimTurn:  # fmt: skip
    poses = (begin or SE3.identity(), end or begin or SE3.identity())
    lidar = Lidar3d(what, mount, params, seed)
    return lidar.turn(stamp_ns, (stamp_ns - S // 10, stamp_ns), poses, faults or Lidar3dFaults())


def on_robot(told: SimTurn) -> Floats:
    """Points in `base_link`."""
    return np.asarray(told.cloud.points + np.array((MOUNT.x, MOUNT.y, MOUNT.z)))


def seen(told: SimTurn, part: Part) -> NDArray[np.bool_]:
    return np.asarray(told.parts == int(part))


def test_a_wall_is_flat_and_where_it_stands() -> None:
    told = turn(scene(wall(7.0)))
    points = on_robot(told)[seen(told, Part.WALL)]
    assert len(points) > 5000
    assert np.abs(points[:, 0] - 7.0).max() < ROUNDED_M


def test_sixteen_beams_two_degrees_apart_look_at_1800_azimuths() -> None:
    told = turn(scene(*(wall(x) for x in (7.0, -7.0))))
    x, y, z = told.cloud.points.T
    elevation_deg = np.degrees(np.arctan2(z, np.hypot(x, y)))
    assert np.abs(elevation_deg - (-15.0 + 2.0 * told.cloud.rings)).max() < 1e-9
    azimuths = np.unique(np.round(np.degrees(np.arctan2(y, x)) * 5.0, 3))
    assert np.abs(azimuths - np.rint(azimuths)).max() < 1e-3, "every 0.2 degrees"
    assert set(told.cloud.rings.tolist()) == set(range(16))


def test_level_ground_is_met_in_circles_whose_radius_the_elevation_gives() -> None:
    told = turn(scene(pole(50.0, 50.0)))
    ground = seen(told, Part.SOIL)
    assert np.abs(on_robot(told)[ground, 2]).max() < 2e-4  # m
    for ring in range(7):
        radius = np.hypot(*told.cloud.points[ground & (told.cloud.rings == ring), :2].T)
        assert radius == pytest.approx(0.6 / math.tan(math.radians(15.0 - 2.0 * ring)), abs=2e-3)  # m
        assert len(radius) == 1800


@settings(deadline=None, max_examples=30)  # the first call compiles
@given(
    x=st.floats(2.0, 20.0), y=st.floats(-10.0, 10.0), yaw=st.floats(-3.1, 3.1), roll=st.floats(-0.08, 0.08),
    pitch=st.floats(-0.08, 0.08),
)  # fmt: skip
def test_a_post_is_met_on_its_skin_from_wherever_the_robot_stands_and_leans(
    x: float, y: float, yaw: float, roll: float, pitch: float
) -> None:
    pose = SE3.from_rpy((3.0, -4.0, 0.0), roll, pitch, yaw)
    told = turn(scene(pole(x + 3.0, y - 4.0)), begin=pose)
    points = pose.apply(on_robot(told))[seen(told, Part.POST)]
    away = math.hypot(x, y)
    beams = math.degrees(math.atan(2.4 / away) + math.atan(0.6 / away)) / 2.0
    assert len(points) > 0.5 * min(beams, 14.0) * 0.1 / away / math.radians(0.2) - 2.0
    assert np.abs(np.hypot(points[:, 0] - x - 3.0, points[:, 1] - y + 4.0) - 0.05).max() < 2 * ROUNDED_M


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


def test_nothing_is_seen_behind_a_wall_but_what_rises_above_it() -> None:
    told = turn(scene(wall(4.0, top=1.5), wall(9.0, Part.FENCE)))
    behind = on_robot(told)[seen(told, Part.FENCE)]
    assert (behind[:, 2] > 0.6 + (1.5 - 0.6) * 8.8 / 3.8 - 0.02).all()
    assert len(behind) > 100
    assert not (seen(told, Part.SOIL) & (on_robot(told)[:, 0] > 4.0)).any()


def test_leaves_hide_some_of_what_is_behind_them_and_let_some_through() -> None:
    rng = np.random.default_rng(3)
    middle = rng.uniform((3.0, -2.0, 0.0), (4.0, 2.0, 3.0), (250, 3))
    what = scene(bunches(middle, np.full(250, 0.15), 0.6, Part.LEAF, rng), wall(6.0))
    told = turn(what)
    x, y, z = told.cloud.points.T
    ahead = (x > 0.0) & (np.abs(y / np.maximum(x, 1e-9)) < 0.3) & (np.abs(z) < 0.2 * x)
    through = (seen(told, Part.WALL) & ahead).sum() / ahead.sum()
    assert 0.1 < through < 0.7


def test_a_wire_is_met_by_some_rays_only_and_less_by_far_ones() -> None:
    def wire(y: float) -> Shapes:
        return rods(np.array([(-30.0, y, 1.2)]), np.array([(30.0, y, 1.2)]), np.array([1e-3]), np.array([1e-3]),
                    Part.WIRE)  # fmt: skip

    counts = {}
    for y in (3.0, 12.0):
        told = turn(scene(wire(y)), C16)
        points = on_robot(told)[seen(told, Part.WIRE)]
        counts[y] = len(points)
        assert np.abs(points[:, 1] - y).max() < 0.12  # m: six sigma
        assert np.abs(points[:, 2] - 1.2).max() < 0.12  # m: and the spot's width
    assert 20 < counts[3.0] < 400
    assert counts[12.0] < counts[3.0]


def test_a_wire_before_a_near_bright_wall_is_lost_in_its_light() -> None:
    wire = rods(
        np.array([(3.0, -5.0, 1.0)]), np.array([(3.0, 5.0, 1.0)]), np.array([1e-3]), np.array([1e-3]), Part.WIRE
    )
    alone, before = turn(scene(wire)), turn(scene(wire, wall(3.3)))
    assert seen(alone, Part.WIRE).sum() > 20
    assert seen(before, Part.WIRE).sum() < 0.2 * seen(alone, Part.WIRE).sum()


def test_edges_give_points_in_between_where_two_surfaces_are_near_each_other() -> None:
    what = scene(pole(5.0, 0.0, 0.2, Part.TRUNK), wall(5.5))
    told, clean = turn(what, replace(FLAWLESS_3D, edge_gap=0.6)), turn(what)
    between = on_robot(told)[seen(told, Part.MIXED)]
    assert len(between) >= 4
    assert ((between[:, 0] > 4.75) & (between[:, 0] < 5.5)).all()
    assert not seen(clean, Part.MIXED).any()


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


def test_grass_is_met_between_its_tops_and_the_soil_and_near_its_tops_at_a_graze() -> None:
    told = turn(scene(pole(90.0, 0.0), ground=level(grass=0.2)))
    grass, z = seen(told, Part.GRASS), on_robot(told)[:, 2]
    assert ((z > -1e-3) & (z < 0.2 + 1e-3))[grass].all()
    steep, flat = (z[grass & (told.cloud.rings == ring)].mean() for ring in (0, 7))
    assert steep < flat
    assert flat > 0.19  # m


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
