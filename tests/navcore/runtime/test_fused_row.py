"""Camera and LiDAR together see the row better than either, and each goes on without the other and says so."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.geometry.lidar_mount import robot_lidar
from navcore.geometry.se2 import SE2
from navcore.messages import (
    CameraName,
    CameraRequest,
    CameraView,
    DetectedObject,
    LidarScan,
    ObjectKind,
    RowSource,
)
from navcore.perception.detector import Image, Told
from navcore.perception.plants.scan_eye import ScanEye
from navcore.perception.row_perception import RowPerception, RowPerceptionParams
from navcore.runtime.row_eye import RowEye
from tests.navcore.perception.corridor_views import FRONT, boxes_at, picture
from tests.navcore.perception.scan.round_trunks import scan_of

WIDTH = 2.5
STEP = 0.08  # m between two pictures
NS = 100_000_000  # between two pictures
MOUNT = robot_lidar()


class Drive:
    """A robot in a young orchard: trunks 10 cm about their lines, boxes a detector is not sure of, noisy scans."""

    def __init__(self, seed: int, *, lidar: bool = True, stakes: int = 0) -> None:
        rng = np.random.default_rng(seed)
        along = np.arange(-8.0, 30.0, 1.5)
        self.trunks = np.array([(x, y) for y in (-1.5 * WIDTH, -WIDTH / 2, WIDTH / 2, 1.5 * WIDTH) for x in along])
        self.trunks += rng.normal(0.0, 0.08, self.trunks.shape)
        self.diameters = rng.uniform(0.05, 0.15, len(self.trunks))
        self.stakes = np.column_stack((rng.uniform(0.0, 20.0, stakes), rng.uniform(-0.6, 0.6, stakes)))
        self.told, self.rng, self.i, self.pose = Told(), rng, 0, SE2(0.0, 0.1, 0.02)
        perception = RowPerception(FRONT, self.told, RowPerceptionParams())
        eye = ScanEye(MOUNT) if lidar else None
        self.boxes_again = False
        self.eye = RowEye({CameraName.FRONT: perception}, {CameraName.FRONT: FRONT}, eye)

    def look(self, *, camera: bool = True, scan: bool = True) -> CameraView:
        """One picture further."""
        image, stamp_ns, request, scans = self.next_look()
        return self.eye.look(image if camera else None, stamp_ns, request, scans=scans if scan else ())

    def next_look(self) -> tuple[Image, int, CameraRequest, tuple[LidarScan, ...]]:
        """What the next moment gives to see."""
        self.pose, self.i = self.pose @ SE2.arc(STEP, -0.0008), self.i + 1
        boxes = self._boxes()
        posts = (replace(box, kind=ObjectKind.POST, confidence=0.5) for box in boxes if self.boxes_again)
        self.told.objects = (*boxes, *posts)
        return picture(FRONT), self.i * NS, self._request(), (self._scan(),)

    def _boxes(self) -> tuple[DetectedObject, ...]:
        # A box about a trunk is nearly twice as wide: trunks sway and fork.
        seen = boxes_at(FRONT, self.pose.inverse().apply(self.trunks), wide=1.9 * self.diameters)
        noise = self.rng.normal(0.0, 1.5, (len(seen), 2))
        return tuple(
            DetectedObject(kind=o.kind, confidence=0.8, x1=o.x1 + du, y1=o.y1, x2=o.x2 + du, y2=o.y2 + dv)
            for o, (du, dv) in zip(seen, noise, strict=True)
            if self.rng.random() < 0.8
        )

    def _scan(self) -> LidarScan:
        there = (self.pose @ SE2(MOUNT.x, MOUNT.y)).inverse()
        things = np.vstack((self.trunks, self.stakes))
        thick = np.concatenate((self.diameters, np.full(len(self.stakes), 0.02)))
        angles, distances = scan_of(there.apply(things), thick, noise=0.01, seed=self.i)
        return LidarScan(
            stamp_ns=self.i * NS, began_ns=self.i * NS - 1, angles=tuple(angles), distances=tuple(distances)
        )

    def _request(self) -> CameraRequest:
        p = self.pose
        return CameraRequest(
            stamp_ns=self.i * NS,
            camera=CameraName.FRONT,
            odom_x=p.x,
            odom_y=p.y,
            odom_yaw=p.yaw,
            offset=-p.y + 0.15,
            heading=-p.yaw,
            offset_std=0.25,
            width=WIDTH,
        )


def error(view: CameraView, pose: SE2) -> tuple[float, float]:
    """Of offset (m) and heading (rad) against the row's middle, which is y = 0."""
    assert view.row.valid, view.row.reason
    assert view.row.offset is not None
    assert view.row.heading is not None
    return view.row.offset + pose.y * math.cos(pose.yaw), view.row.heading + pose.yaw


def rms(seed: int, count: int = 60, **how: bool) -> tuple[float, float]:
    drive = Drive(seed, lidar=how.pop("lidar", True))
    views = [(drive.look(**how), drive.pose) for _ in range(count)]
    errors = np.array([error(view, pose) for view, pose in views[15:]])
    offset, heading = np.sqrt(np.mean(errors**2, axis=0))
    return float(offset), float(heading)


def test_the_middle_is_known_to_two_centimetres_and_better_than_by_the_camera_alone() -> None:
    fused, alone = (np.array([rms(seed, lidar=lidar) for seed in range(6)]) for lidar in (True, False))
    assert np.mean(fused[:, 0]) < 0.02  # m
    assert np.mean(fused[:, 0]) < np.mean(alone[:, 0])
    assert np.degrees(np.mean(fused[:, 1])) < 0.5


def test_nearly_all_objects_are_given_the_plant_that_they_are() -> None:
    drive, right, wrong, whole = Drive(3), 0, 0, 0
    for _ in range(40):
        view = drive.look()
        boxes = {p.object: p for p in view.plants if p.object is not None}
        for i, box in enumerate(view.objects):
            truth = drive.trunks[_trunk_of(drive, box)]
            at = drive.pose.inverse().apply(truth[None])[0]
            if drive.i > 10 and math.hypot(*at) < 8.0:
                whole += 1
                near = i in boxes and math.dist((boxes[i].x, boxes[i].y), at) < 0.15
                right, wrong = right + near, wrong + (i in boxes and not near)
    assert whole > 150
    assert right >= 0.95 * whole
    assert wrong <= 0.01 * whole


def test_a_tree_that_is_told_as_a_post_as_well_is_one_tree() -> None:
    """And each of its boxes keeps its own bearing: the watch of the camera's mount looks it up by number."""
    plain, doubled = Drive(3), Drive(3)
    doubled.boxes_again = True
    for _ in range(30):
        alone, view = plain.look(), doubled.look()
        assert view.row == alone.row
        assert len(view.objects) == 2 * len(alone.objects)
        assert len(view.bearings) == (len(view.objects) if view.plants else 0)
        for plant in view.plants:
            if plant.object is not None:
                straight_at = math.atan2(plant.y, plant.x - view.camera_x)
                assert view.bearings[plant.object] == pytest.approx(straight_at, abs=math.radians(3.0))
    assert any(plant.object is not None for plant in view.plants)


def _trunk_of(drive: Drive, box: DetectedObject) -> int:
    """The trunk whose foot is nearest to a box's, in pixels."""
    at = drive.pose.inverse().apply(drive.trunks)
    feet = FRONT.project(np.column_stack((at, np.zeros(len(at)))))
    off = np.hypot(feet[:, 0] - (box.x1 + box.x2) / 2, feet[:, 1] - box.y2)
    return int(np.nanargmin(off))


def test_without_a_picture_the_lidar_goes_on_and_says_so() -> None:
    drive = Drive(1)
    views = [drive.look() for _ in range(20)]
    assert views[-1].row.source is RowSource.FUSED
    assert views[-1].row.missing == ""
    blind = [drive.look(camera=False) for _ in range(60)]
    assert all(v.row.valid and v.row.source is RowSource.LIDAR for v in blind)
    assert all(v.row.missing == "the camera gives no picture" for v in blind)
    assert abs(error(blind[-1], drive.pose)[0]) < 0.06  # m


def test_without_scans_the_camera_goes_on_and_says_so() -> None:
    drive = Drive(2)
    for _ in range(20):
        drive.look()
    deaf = [drive.look(scan=False) for _ in range(30)]
    assert all(v.row.valid for v in deaf)
    assert deaf[-1].row.source is RowSource.CAMERA
    assert "the LiDAR has been silent for" in deaf[-1].row.missing
    again = [drive.look() for _ in range(10)]
    assert again[-1].row.source is RowSource.FUSED
    assert again[-1].row.missing == ""


def test_the_lidar_alone_finds_the_row_that_is_expected() -> None:
    drive = Drive(4)
    views = [drive.look(camera=False) for _ in range(40)]
    assert views[-1].row.valid, views[-1].row.reason
    assert abs(error(views[-1], drive.pose)[0]) < 0.06  # m


def test_stakes_inside_the_row_do_not_move_the_middle() -> None:
    drive = Drive(5, stakes=12)
    errors = [error(drive.look(), drive.pose)[0] for _ in range(60)][15:]
    assert np.sqrt(np.mean(np.square(errors))) < 0.03  # m


def test_each_plant_is_told_on_the_line_that_it_stands_on() -> None:
    drive = Drive(8)
    view = [drive.look() for _ in range(20)][-1]
    told = {True: 0, False: 0}
    for plant in view.plants:
        y = drive.pose.apply_point(plant.x, plant.y)[1]
        off = abs(abs(y) - WIDTH / 2)
        if abs(plant.x) < 8.0 and plant.sureness > 0.5 and not 0.12 < off < 0.4:  # m
            assert plant.side == (np.sign(y) if off <= 0.12 else 0), (plant, y)
            told[off <= 0.12] += 1
    assert min(told.values()) >= 8


def test_where_no_row_is_expected_the_lidar_tells_nothing_and_begins_anew() -> None:
    """Nobody tells then how the robot moves, and what was seen before would be smeared over the farm."""
    drive = Drive(9)
    for _ in range(15):
        drive.look()
    for _ in range(3):
        drive.i += 1
        nothing = CameraRequest(stamp_ns=drive.i * NS, camera=CameraName.FRONT, odom_x=0.0, odom_y=0.0, odom_yaw=0.0)
        view = drive.eye.look(picture(FRONT), drive.i * NS, nothing, scans=(drive._scan(),))
        assert view.plants == ()
        assert view.row.source is RowSource.CAMERA
        assert view.row.missing == ""
    views = [(drive.look(), drive.pose) for _ in range(20)]
    assert max(abs(error(view, pose)[0]) for view, pose in views[8:]) < 0.05  # m


def test_a_blind_lidar_is_named() -> None:
    drive = Drive(6)
    for _ in range(12):
        drive.look()
    angles = tuple(float(a) for a in -np.arange(1600) * 0.0039)
    drive.i += 1
    nothing = LidarScan(stamp_ns=drive.i * NS, began_ns=drive.i * NS - 1, angles=angles, distances=(0.0,) * 1600)
    view = drive.eye.look(picture(FRONT), drive.i * NS, drive._request(), scans=(nothing,))
    assert view.row.source is RowSource.CAMERA
    assert "sees nothing at all" in view.row.missing


def test_a_picture_alone_is_as_good_as_without_a_lidar() -> None:
    drive, without = Drive(7), Drive(7, lidar=False)
    for _ in range(15):
        a, b = drive.look(scan=False).row, without.look().row
        assert a.offset == pytest.approx(b.offset, abs=1e-12)


def test_what_the_lidar_meets_is_drawn_even_where_none_of_it_is_a_plant() -> None:
    drive = Drive(3)
    drive.trunks, drive.diameters = np.array(((4.0, 0.0),)), np.array((2.0,))
    drive.look(camera=False)
    view = drive.look(camera=False)
    assert not view.plants
    assert view.ends


def test_what_is_drawn_later_is_the_row_that_was_told_first() -> None:
    told, drawn = Drive(3), Drive(3)
    for _ in range(20):
        seen = told.eye.observe(*told.next_look())
        view = drawn.look()
        assert told.eye.drawn(seen, 40.0) == replace(view, latency_ms=40.0)
        assert seen.row == view.row
