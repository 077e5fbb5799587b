"""Trunks are followed from scan to scan: they stay where they are, and the robot is where they say."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2
from navcore.perception.plants.plant_tracker import PlantTracker
from navcore.perception.scan.scan_clusters import ScanClusters
from tests.navcore.perception.scan.round_trunks import RAYS, scan_of

MOUNT = LidarMount(x=0.3, y=0.0, z=0.55)
LIDAR = SE2(MOUNT.x, MOUNT.y, 0.0)
SPEED = 0.08  # m between two scans


def orchard(seed: int = 1, length: float = 30.0) -> tuple[np.ndarray, np.ndarray]:
    """Places (N, 2) and diameters (N,) of trunks on four lines along x."""
    rng = np.random.default_rng(seed)
    along = np.arange(-6.0, length, 1.4)
    xy = np.array([(x, y) for y in (-3.75, -1.25, 1.25, 3.75) for x in along])
    xy += rng.normal(0.0, 0.06, xy.shape)
    return xy, rng.uniform(0.05, 0.15, len(xy))


def scans(tracker: PlantTracker, count: int, *, slip: float = 1.0, turn: float = 0.0) -> list[SE2]:
    """Drive along x through the orchard; the true poses. Odometry tells `slip` times the way and the turn."""
    xy, diameters = orchard()
    pose, poses, told = SE2(), [SE2()], SE2()
    for i in range(count):
        seen = (pose @ LIDAR).inverse().apply(xy)
        angles, distances = scan_of(seen, diameters, noise=0.01, seed=i)
        tracker.see(ScanClusters().find(angles, distances), told)
        step = SE2.arc(SPEED, turn)
        poses.append(pose)
        pose, told = pose @ step, SE2.arc(SPEED * slip, turn * slip)
    return poses


def test_plants_stay_where_they_are_while_the_robot_drives() -> None:
    tracker = PlantTracker(MOUNT)
    pose = scans(tracker, 80)[-1]
    plants = tracker.plants()
    there = pose.apply(plants.xy)
    off = np.min(np.linalg.norm(there[:, None] - orchard()[0][None], axis=2), axis=1)
    sure = plants.hits >= 10
    assert np.count_nonzero(sure) >= 30
    assert np.percentile(off[sure], 95) < 0.03  # m


def test_wheels_that_slip_by_a_tenth_do_not_lead_astray() -> None:
    tracker = PlantTracker(MOUNT)
    pose = scans(tracker, 80, slip=1.1, turn=0.004)[-1]
    plants = tracker.plants()
    there = pose.apply(plants.xy[plants.hits >= 10])
    off = np.min(np.linalg.norm(there[:, None] - orchard()[0][None], axis=2), axis=1)
    assert np.median(off) < 0.04  # m; by odometry alone 0.6


def test_a_plant_keeps_its_number() -> None:
    tracker = PlantTracker(MOUNT)
    scans(tracker, 5)
    before = tracker.plants()
    xy, diameters = orchard()
    for i in range(5, 10):
        seen = (SE2(SPEED * i, 0.0) @ LIDAR).inverse().apply(xy)
        tracker.see(ScanClusters().find(*scan_of(seen, diameters, noise=0.01, seed=i)), SE2(SPEED, 0.0))
    after = tracker.plants()
    for number, at in zip(before.number, before.xy, strict=True):
        where = np.flatnonzero(after.number == number)
        if len(where):
            assert after.xy[where[0]] == pytest.approx(at - (SPEED * 5, 0.0), abs=0.06)  # m
    assert len(np.intersect1d(before.number, after.number)) > 0.9 * len(before)


def test_diameters_of_near_trunks_are_right_to_a_centimetre() -> None:
    tracker = PlantTracker(MOUNT)
    pose = scans(tracker, 40)[-1]
    plants, (xy, diameters) = tracker.plants(), orchard()
    near = np.linalg.norm(plants.xy - (MOUNT.x, MOUNT.y), axis=1) < 2.0
    apart = np.linalg.norm(pose.apply(plants.xy[near])[:, None] - xy[None], axis=2)
    errors = plants.diameter[near] - diameters[np.argmin(apart, axis=1)]
    assert np.count_nonzero(near) >= 4
    assert np.max(np.abs(errors)) < 0.01  # m


def test_rays_taken_early_in_a_turn_are_carried_on_to_its_end() -> None:
    """A robot at 2 m/s drives 0.2 m while the sensor turns; its scan is that of a robot that stood at its end."""
    xy, diameters = orchard()
    angles = np.zeros(RAYS)
    distances = np.zeros(RAYS)
    for i in range(RAYS):
        if i % 40 == 0:  # poses in steps of 2.5 ms
            at = SE2(-0.2 * (1.0 - i / RAYS), 0.0)
            angles, whole = scan_of((at @ LIDAR).inverse().apply(xy), diameters)
        distances[i] = whole[i]
    moving, standing = PlantTracker(MOUNT), PlantTracker(MOUNT)
    still = scan_of(LIDAR.inverse().apply(xy), diameters)
    for _ in range(2):
        moving.see(ScanClusters().find(angles, distances), SE2(), SE2(0.2, 0.0))
        standing.see(ScanClusters().find(*still), SE2())
    a, b = moving.plants().xy, standing.plants().xy
    apart = np.min(np.linalg.norm(a[:, None] - b[None], axis=2), axis=1)
    near = np.linalg.norm(a, axis=1) < 4.0
    assert np.max(apart[near]) < 0.02  # m; 0.2 if nothing were carried on


def test_what_the_camera_calls_a_trunk_becomes_sure_and_what_it_does_not_does_not() -> None:
    tracker = PlantTracker(MOUNT)
    scans(tracker, 4)
    first, second = tracker.plants().number[:2]
    for _ in range(6):
        tracker.told_by_camera(np.array([first]), np.array([second]))
    plants = tracker.plants()
    assert plants.sureness[plants.number == first][0] > 0.9
    assert plants.sureness[plants.number == second][0] < 0.4


def test_a_stake_is_less_sure_than_a_trunk() -> None:
    tracker = PlantTracker(MOUNT)
    places = np.array([(1.5, 1.0), (1.5, -1.0)])
    for i in range(8):
        tracker.see(ScanClusters().find(*scan_of(places, np.array([0.1, 0.02]), noise=0.01, seed=i)), SE2())
    plants = tracker.plants()
    trunk = plants.sureness[np.argmax(plants.diameter)]
    assert trunk > 0.6
    assert all(s < 0.4 for s in np.delete(plants.sureness, np.argmax(plants.diameter)))


def test_what_passes_by_is_forgotten_and_what_stands_is_not() -> None:
    tracker = PlantTracker(MOUNT)
    for i in range(30):
        places = np.array([(2.0, 1.2), (3.0 - 0.25 * i, -1.0)])
        tracker.see(ScanClusters().find(*scan_of(places, np.array([0.1, 0.2]))), SE2())
    assert len(tracker.plants()) == 1
    assert math.dist(tracker.plants().xy[0], (2.3, 1.2)) < 0.03  # m, the mount being 0.3 m ahead


def watched(tracker: PlantTracker, places: list[tuple[float, float]], diameters: list[float], count: int) -> None:
    """So many scans of what stands about the sensor, seen and looked past."""
    for i in range(count):
        angles, distances = scan_of(np.array(places).reshape(-1, 2), np.array(diameters), noise=0.005, seed=i)
        tracker.see(ScanClusters().find(angles, distances), SE2())
        tracker.look_past(angles, distances)


def sureness_at(tracker: PlantTracker, place: tuple[float, float]) -> float:
    """Of the plant that stands there, by the sensor."""
    plants = tracker.plants()
    return float(plants.sureness[np.argmin(np.linalg.norm(plants.xy - place - (MOUNT.x, MOUNT.y), axis=1))])


def test_what_scans_look_past_is_hardly_a_trunk_until_they_meet_it_again() -> None:
    tracker, place = PlantTracker(MOUNT), (2.0, 1.0)
    watched(tracker, [place], [0.1], 10)
    before = sureness_at(tracker, place)
    watched(tracker, [(3.6, 1.8)], [0.4], 10)
    assert sureness_at(tracker, place) < 0.05 < 0.5 < before
    watched(tracker, [place], [0.1], 10)
    assert sureness_at(tracker, place) == pytest.approx(before)


def test_a_trunk_behind_something_is_as_sure_as_before() -> None:
    tracker, place = PlantTracker(MOUNT), (2.0, 1.0)
    watched(tracker, [place], [0.1], 10)
    before = sureness_at(tracker, place)
    watched(tracker, [(1.0, 0.5)], [0.2], 10)
    assert sureness_at(tracker, place) == pytest.approx(before)
