"""Boxes of the picture and plants of the scan: who is who."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import robot_lidar
from navcore.geometry.pinhole import PinholeCamera, robot_camera
from navcore.geometry.se2 import SE2
from navcore.messages import DetectedObject, ObjectKind
from navcore.perception.plants.box_association import associate
from navcore.perception.plants.plant_tracker import PlantTracker
from navcore.perception.plants.scanned_plants import ScannedPlants
from navcore.perception.scan.scan_clusters import ScanClusters
from tests.navcore.perception.scan.round_trunks import scan_of

CAMERA = robot_camera()
WIDER = 1.9  # a box about a trunk is wider than the trunk
ROW = ((2.5, 1.3), (2.6, -1.3), (4.0, 1.25), (4.1, -1.35), (5.5, 1.3), (5.6, -1.3))


def scanned(places: tuple[tuple[float, float], ...], diameter: float = 0.09) -> ScannedPlants:
    n = len(places)
    return ScannedPlants(
        number=np.arange(n), xy=np.array(places).reshape(-1, 2), std=np.full(n, 0.01),
        diameter=np.full(n, diameter), hits=np.full(n, 20), sureness=np.full(n, 0.9), height=0.55,
    )  # fmt: skip


def boxed(
    places: tuple[tuple[float, float], ...], camera: PinholeCamera = CAMERA, diameter: float = 0.09
) -> tuple[DetectedObject, ...]:
    """A box about each trunk from the ground to 0.9 m above it."""
    found = []
    for x, y in places:
        foot, head = camera.project(np.array(((x, y, 0.0), (x, y, 0.9))))
        half = 0.5 * WIDER * camera.fx * diameter / (x - camera.x)
        found.append(
            DetectedObject(
                kind=ObjectKind.TRUNK, confidence=0.8, x1=foot[0] - half, y1=head[1], x2=foot[0] + half, y2=foot[1]
            )
        )
    return tuple(found)


def pairs(objects: tuple[DetectedObject, ...], plants: ScannedPlants, pitch: float = 0.0) -> NDArray[np.int64]:
    return associate(objects, plants, CAMERA, pitch)


def test_each_box_is_the_plant_that_stands_there() -> None:
    order = np.array((3, 0, 5, 1, 4, 2))
    assert pairs(boxed(tuple(ROW[i] for i in order)), scanned(ROW)).tolist() == order.tolist()


def test_a_box_with_no_plant_behind_it_has_none() -> None:
    assert pairs(boxed(((3.0, 0.3), *ROW[:2])), scanned(ROW)).tolist() == [-1, 0, 1]
    assert pairs(boxed(ROW), scanned(())).tolist() == [-1] * 6
    assert pairs((), scanned(ROW)).tolist() == []


def test_a_thin_stake_beside_a_trunk_is_not_taken_for_it() -> None:
    trunk, stake = scanned(((4.0, 1.25),)), scanned(((4.2, 1.30),), diameter=0.025)
    both = ScannedPlants(
        number=np.arange(2), xy=np.vstack((stake.xy, trunk.xy)), std=np.full(2, 0.01),
        diameter=np.concatenate((stake.diameter, trunk.diameter)), hits=np.full(2, 20),
        sureness=np.full(2, 0.9), height=0.55,
    )  # fmt: skip
    assert pairs(boxed(((4.0, 1.25),)), both).tolist() == [1]


def test_of_two_plants_that_fit_alike_neither_is_taken() -> None:
    """One behind the other, 0.5 m apart."""
    twins = scanned(((5.0, 1.30), (5.5, 1.44)))
    assert pairs(boxed(((5.25, 1.37),)), twins).tolist() == [-1]


def test_which_of_two_plants_that_stand_together_it_is_does_not_matter() -> None:
    """A tree and the stake that it is tied to: the object stands there, whichever of them it is."""
    twins = scanned(((5.0, 1.30), (5.15, 1.335)))
    assert pairs(boxed(((5.07, 1.317),)), twins)[0] in (0, 1)


def test_near_feet_tell_the_pitch_by_which_far_plants_are_found() -> None:
    """The robot nods by 2 deg more than the IMU says; 7 m away that is 2 m of distance."""
    nodding = replace(CAMERA, pitch=CAMERA.pitch + 0.035)
    row = (*ROW, (7.0, 1.3), (7.1, -1.3))
    assert pairs(boxed(row, nodding), scanned(row)).tolist() == list(range(8))


def test_a_weed_in_line_with_a_trunk_does_not_get_its_box_once_scans_looked_past_it() -> None:
    """0.5 m before the trunk; two scans of three find a way through its leaves, and meet the trunk."""
    trunk, weed = (4.7, 1.4), (4.22, 1.257)  # by the LiDAR, which sits 0.3 m ahead of `base_link`
    for looks, is_trunk in ((PlantTracker.look_past, True), (lambda *_: None, False)):
        tracker = PlantTracker(robot_lidar())
        for i in range(24):
            seen = [trunk] if i % 3 else [trunk, weed]
            angles, distances = scan_of(np.array(seen), np.full(len(seen), 0.1), noise=0.005, seed=i)
            tracker.see(ScanClusters().find(angles, distances), SE2())
            looks(tracker, angles, distances)
        plants = tracker.plants()
        found = associate(boxed(((4.76, 1.329),), diameter=0.1), plants, CAMERA, 0.0)
        got = found[0] >= 0 and math.dist(plants.xy[found[0]], (5.0, 1.4)) < 0.1
        assert got == is_trunk
