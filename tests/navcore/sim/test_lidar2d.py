"""The simulated LiDAR hits what stands there, from where the robot is at that moment, and errs as a real one does."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.geometry.lidar_mount import LidarMount
from navcore.messages import LidarScan
from navcore.sim.layouts import tuning_layout
from navcore.sim.lidar2d import Lidar2d, Lidar2dParams, LidarFaults
from navcore.sim.orchard import Orchard, OrchardParams, build_orchard
from navcore.sim.render.planting import planted

MS = 1_000_000
STRAIGHT = (0.0, 0.0, 0.0)
EXACT = Lidar2dParams(noise=0.0, noise_share=0.0, scale_std=0.0, lost=0.0, beam_deg=0.0, latency_s=0.0)


@pytest.fixture(scope="module")
def orchard() -> Orchard:
    return build_orchard(tuning_layout(3), OrchardParams(seed=3))


def in_row(orchard: Orchard) -> tuple[float, float, float]:
    """Ten metres into a row, looking along it."""
    x0, y0, x1, y1 = orchard.plant_lines[0]
    yaw = math.atan2(y1 - y0, x1 - x0)
    aside = float(orchard.line_reach[0])
    return x0 + 10 * math.cos(yaw) - aside * math.sin(yaw), y0 + 10 * math.sin(yaw) + aside * math.cos(yaw), yaw


def turn(lidar: Lidar2d, pose: tuple[float, float, float], speed: float = 0.0, lean: float = 0.0) -> LidarScan:
    """The first turn of a robot that starts at `pose` and drives straight ahead."""
    x, y, yaw = pose
    for i in range(1, 41):
        s = speed * 0.005 * i
        lidar.step(i * 5 * MS, x + s * math.cos(yaw), y + s * math.sin(yaw), (lean, 0.0, yaw))
        if scans := lidar.due(i * 5 * MS):
            return scans[0]
    raise AssertionError("no turn")


def ends(scan: LidarScan, pose: tuple[float, float, float], mount: LidarMount) -> np.ndarray:
    """Where rays end that came back, (N, 3) in `map`, the robot standing at `pose`."""
    distances = np.array(scan.distances)
    p = mount.ends(np.array(scan.angles), distances)[distances > 0.0]
    c, s = math.cos(pose[2]), math.sin(pose[2])
    return np.column_stack((pose[0] + c * p[:, 0] - s * p[:, 1], pose[1] + s * p[:, 0] + c * p[:, 1], p[:, 2]))


def test_every_ray_ends_on_the_bark_of_something_that_the_camera_draws(orchard: Orchard) -> None:
    pose = in_row(orchard)
    scan = turn(Lidar2d(orchard, EXACT, np.random.default_rng(1)), pose)
    assert len(scan.distances) == 1600
    hits = ends(scan, pose, EXACT.mount)
    tubes = planted(orchard, np.zeros((0, 15))).tubes
    assert len(hits) > 60
    for x, y, z in hits:
        k = int(np.argmin(np.hypot(tubes[:, 0, 0] - x, tubes[:, 0, 1] - y)))
        at = [float(np.interp(z, tubes[k, :, 2], tubes[k, :, a])) for a in (0, 1, 3)]
        assert math.hypot(x - at[0], y - at[1]) == pytest.approx(at[2], abs=0.004)  # m


def test_a_turn_takes_a_tenth_of_a_second_to_the_right_and_comes_after_its_latency(orchard: Orchard) -> None:
    lidar = Lidar2d(orchard, Lidar2dParams(latency_s=0.02), np.random.default_rng(1))
    for i in range(1, 25):
        lidar.step(i * 5 * MS, *in_row(orchard)[:2], STRAIGHT)
        scans = lidar.due(i * 5 * MS)
        assert bool(scans) == (i * 5 == 120)
        if scans:
            assert (scans[0].began_ns, scans[0].stamp_ns) == (0, 100 * MS)
            assert np.all(np.diff(scans[0].angles) == pytest.approx(-math.radians(0.225), abs=2e-5))


def test_the_robots_own_motion_distorts_a_turn(orchard: Orchard) -> None:
    """At 2 m/s the first rays see the world 0.2 m further ahead than the last."""
    pose = in_row(orchard)
    still = turn(Lidar2d(orchard, EXACT, np.random.default_rng(1)), pose)
    x, y, yaw = pose
    before = (x - 0.2 * math.cos(yaw), y - 0.2 * math.sin(yaw), yaw)
    moving = turn(Lidar2d(orchard, EXACT, np.random.default_rng(1)), before, 2.0)
    a, b = ends(still, pose, EXACT.mount)[:, :2], ends(moving, pose, EXACT.mount)[:, :2]
    nearest = np.min(np.linalg.norm(a[:, None] - b[None], axis=2), axis=1)
    assert 0.1 < np.max(nearest[np.linalg.norm(a - (x, y), axis=1) < 4.0]) < 0.35  # m
    assert np.allclose(moving.distances[-20:], still.distances[-20:], atol=0.03)  # m


def test_ranges_err_as_they_are_told_to(orchard: Orchard) -> None:
    pose, params = in_row(orchard), Lidar2dParams(scale_std=0.0, lost=0.0, beam_deg=0.0, latency_s=0.0)
    exact = np.array(turn(Lidar2d(orchard, EXACT, np.random.default_rng(1)), pose).distances)
    off = []
    for seed in range(20):
        noisy = np.array(turn(Lidar2d(orchard, params, np.random.default_rng(seed)), pose).distances)
        off.append((noisy - exact)[(exact > 0.3) & (exact < 3.0)])
    assert np.std(np.concatenate(off)) == pytest.approx(0.012, abs=0.002)  # m: 1 cm and 0.4 % of some 2 m


def test_edges_tell_ranges_between_what_stands_there_and_what_stands_behind(orchard: Orchard) -> None:
    x0, y0, x1, y1 = orchard.plant_lines[0]
    yaw = math.atan2(y1 - y0, x1 - x0)
    pose = x0 - 2.0 * math.cos(yaw), y0 - 2.0 * math.sin(yaw), yaw  # trunks stand one behind the other
    params = replace(EXACT, beam_deg=0.3)
    exact = np.array(turn(Lidar2d(orchard, EXACT, np.random.default_rng(1)), pose).distances)
    seen = [np.array(turn(Lidar2d(orchard, params, np.random.default_rng(s)), pose).distances) for s in range(5)]
    longer = np.concatenate([distances - exact for distances in seen])
    assert np.count_nonzero(longer > 0.05) > 5
    assert np.min(longer) > -1e-3  # m


def test_the_same_seed_gives_the_same_bits(orchard: Orchard) -> None:
    pose = in_row(orchard)
    scans = [turn(Lidar2d(orchard, Lidar2dParams(latency_s=0.0), np.random.default_rng(s)), pose) for s in (7, 7, 8)]
    assert scans[0] == scans[1]
    assert scans[0] != scans[2]


def test_a_leaning_robot_sees_the_ground(orchard: Orchard) -> None:
    pose = in_row(orchard)
    level = turn(Lidar2d(orchard, EXACT, np.random.default_rng(1)), pose)
    leaning = turn(Lidar2d(orchard, EXACT, np.random.default_rng(1)), pose, lean=math.radians(6.0))
    assert np.count_nonzero(leaning.distances) > 3 * np.count_nonzero(level.distances)
    right = np.array(leaning.distances)[400]  # straight to the right, where the left side is up
    assert right == pytest.approx(EXACT.mount.z / math.tan(math.radians(6.0)), rel=0.05)


def test_what_is_broken_is_broken(orchard: Orchard) -> None:
    pose = in_row(orchard)
    lidar = Lidar2d(orchard, EXACT, np.random.default_rng(1))
    lidar.faults = LidarFaults(zeros=True)
    assert not np.any(turn(lidar, pose).distances)
    lidar = Lidar2d(orchard, EXACT, np.random.default_rng(1))
    lidar.faults = LidarFaults(blinded_deg=(-90.0, 0.0))
    blind = np.array(turn(lidar, pose).distances)
    assert not np.any(blind[1:400])
    assert np.any(blind[401:])
    lidar = Lidar2d(orchard, EXACT, np.random.default_rng(1))
    lidar.faults = LidarFaults(silent=True)
    with pytest.raises(AssertionError, match="no turn"):
        turn(lidar, pose)


def test_a_turned_mount_sees_all_of_it_turned(orchard: Orchard) -> None:
    pose = in_row(orchard)
    straight = turn(Lidar2d(orchard, EXACT, np.random.default_rng(1)), pose)
    lidar = Lidar2d(orchard, EXACT, np.random.default_rng(1))
    lidar.faults = LidarFaults(turned_deg=-9.0)
    turned = turn(lidar, pose)
    assert turned.distances[:1500] == pytest.approx(straight.distances[40:1540], abs=0.002)  # m; 9 deg are 40 rays
