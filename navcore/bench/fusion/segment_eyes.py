"""The eyes that are compared on paper B's segments: ours, the true trunks, and the published chains."""

from __future__ import annotations

import math
import time

import numpy as np

from navcore.bench.fusion.segment_cases import Chain, SegmentCase
from navcore.bench.mission.cases import EyeKind
from navcore.config import RobotConfig
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2
from navcore.messages import (
    CameraName,
    CameraRequest,
    CameraView,
    DetectedObject,
    LidarScan,
    RowObservation,
    RowSource,
    SimTruth,
)
from navcore.perception.detector import Detector, Image, Told
from navcore.perception.onnx_detector import OnnxDetector
from navcore.perception.plants.odometry_trail import OdometryTrail
from navcore.perception.plants.scan_eye import ScanEye
from navcore.perception.plants.scanned_plants import ScannedPlants
from navcore.perception.published_fusion.published_chain import (
    LidarRansac,
    PublishedFusion,
    PublishedFusionParams,
    PublishedView,
    RowChain,
    VisionRansac,
)
from navcore.perception.row_perception import RowPerception
from navcore.perception.scan.scan_points import ScanPointsParams, scan_points
from navcore.runtime.row_eye import RowEye
from navcore.runtime.simulation import robot_cameras
from navcore.sim.camera_light import named_light
from navcore.sim.camera_renderer import CameraRenderer, Scene
from navcore.sim.orchard import Orchard
from navcore.sim.projected_objects import ProjectedObjects, ProjectedObjectsParams
from navcore.sim.trunk_sections import trunk_sections

REACH_M = 10.0


class Pictures:
    """What a camera gives at a true pose, and a detector that keeps what it found last."""

    def __init__(self, orchard: Orchard, case: SegmentCase, seed: int) -> None:
        self.objects: tuple[DetectedObject, ...] = ()
        self._frames, self._cameras = 0, robot_cameras()
        self._knowing: dict[CameraName, ProjectedObjects] = {}
        self._renderers: dict[CameraName, CameraRenderer] = {}
        rng = np.random.default_rng(seed)
        if case.eye is EyeKind.TRUTH:
            faults = ProjectedObjectsParams()
            self._knowing = {n: ProjectedObjects(orchard, c, faults, rng) for n, c in self._cameras.items()}
            self._blank = rng.integers(0, 255, (360, 640, 3), dtype=np.uint8)
            return
        light = named_light(case.light, seed=seed)
        scene = Scene(orchard, light)
        self._renderers = {n: CameraRenderer(orchard, c, light, scene=scene) for n, c in self._cameras.items()}
        self._detector = OnnxDetector()

    def take(self, truth: SimTruth, camera: CameraName) -> Image:
        """The picture at that pose."""
        self._frames += 1
        if self._knowing:
            self._knowing[camera].look_from(truth)
            return self._blank
        return self._renderers[camera].render(truth, self._frames).image

    def detector(self, camera: CameraName) -> Detector:
        """What finds trunks in that camera's pictures."""
        return _Keeping(self, self._knowing[camera] if self._knowing else self._detector)


class _Keeping:
    def __init__(self, pictures: Pictures, inner: Detector) -> None:
        self._pictures, self._inner = pictures, inner

    def detect(self, image: Image) -> tuple[DetectedObject, ...]:
        """See `Detector`."""
        self._pictures.objects = self._inner.detect(image)
        return self._pictures.objects


class OurEye:
    """Camera and LiDAR as the row worker sees with them.

    `seconds` are what each look took that showed a row to both, until the row was known: the picture, its boxes and
    what is drawn for those who look on are left out.
    """

    def __init__(self, pictures: Pictures, config: RobotConfig, mount: LidarMount) -> None:
        cameras, self._told = robot_cameras(), Told()
        perceptions = {n: RowPerception(c, self._told, config.perception) for n, c in cameras.items()}
        self._pictures, self._eye = pictures, RowEye(perceptions, cameras, ScanEye(mount, config.scan))
        self.seconds: list[float] = []

    def look(self, truth: SimTruth, request: CameraRequest, scans: tuple[LidarScan, ...] = ()) -> CameraView:
        """See `lockstep.Eye`."""
        image = self._pictures.take(truth, request.camera)
        objects = self._pictures.detector(request.camera).detect(image)
        return self.see(image, objects, truth.stamp_ns, request, scans)

    def see(
        self, image: Image, objects: tuple[DetectedObject, ...], stamp_ns: int, request: CameraRequest,
        scans: tuple[LidarScan, ...],
    ) -> CameraView:  # fmt: skip
        """What these boxes of the picture and these scans show."""
        self._told.objects = objects
        began = time.perf_counter()
        seen = self._eye.observe(image, stamp_ns, request, scans)
        if seen.row.valid and seen.row.source is RowSource.FUSED:
            self.seconds.append(time.perf_counter() - began)
        return self._eye.drawn(seen)


class OracleEye:
    """The same fit on the trunks themselves, within reach and as far as they stand on both sides."""

    def __init__(self, orchard: Orchard, config: RobotConfig, mount: LidarMount) -> None:
        cameras = robot_cameras()
        self._plants = TruePlants(orchard, mount)
        perceptions = {n: RowPerception(c, _Nothing(), config.perception) for n, c in cameras.items()}
        self._eye = RowEye(perceptions, cameras, self._plants)

    def look(self, truth: SimTruth, request: CameraRequest, scans: tuple[LidarScan, ...] = ()) -> CameraView:
        """See `lockstep.Eye`."""
        self._plants.truth = truth
        return self._eye.look(None, truth.stamp_ns, request)


class _Nothing:
    def detect(self, image: Image) -> tuple[DetectedObject, ...]:
        """See `Detector`."""
        return ()


class TruePlants(ScanEye):
    """In place of a LiDAR: all trunks within reach, exactly. They are where a level scan would meet them."""

    def __init__(self, orchard: Orchard, mount: LidarMount) -> None:
        super().__init__(mount)
        sections = trunk_sections(orchard, mount.z)
        self._sections = sections[np.isfinite(sections[:, 0])]
        self.truth: SimTruth | None = None

    def plants(self, stamp_ns: int, trail: OdometryTrail) -> ScannedPlants | None:
        """See `ScanEye`."""
        if self.truth is None:
            return None
        t = self.truth
        xy = SE2(t.x, t.y, t.yaw).inverse().apply(self._sections[:, :2])
        xy[:, 1] += self.mount.z * math.sin(t.roll)
        near = np.flatnonzero(np.hypot(xy[:, 0], xy[:, 1]) < REACH_M)
        n = len(near)
        return ScannedPlants(
            number=near, xy=xy[near], std=np.full(n, 0.001), diameter=2.0 * self._sections[near, 2],
            hits=np.full(n, 100), sureness=np.ones(n), height=self.mount.z,
        )  # fmt: skip


class ChainEye:
    """A published chain, fed with each picture and the newest scan; `seen` is what it made of them last, `seconds`
    what each time took that showed a row.
    """

    def __init__(self, chain: RowChain, pictures: Pictures | None, mount: LidarMount) -> None:
        self._chain, self._pictures, self._mount = chain, pictures, mount
        self._trail = OdometryTrail()
        self._scan = LidarScan(stamp_ns=0, began_ns=0, angles=(), distances=())
        self.seen: PublishedView | None = None
        self.seconds: list[float] = []

    def look(self, truth: SimTruth, request: CameraRequest, scans: tuple[LidarScan, ...] = ()) -> CameraView:
        """See `lockstep.Eye`."""
        objects: tuple[DetectedObject, ...] = ()
        if self._pictures is not None:
            objects = self._pictures.detector(request.camera).detect(self._pictures.take(truth, request.camera))
        return bare_view(self.feed(truth.stamp_ns, request, objects, scans), objects)

    def feed(
        self, stamp_ns: int, request: CameraRequest, objects: tuple[DetectedObject, ...], scans: tuple[LidarScan, ...]
    ) -> RowObservation:  # fmt: skip
        """The row by these boxes and the newest scan."""
        started = time.perf_counter()
        self._trail.add(request.stamp_ns, SE2(request.odom_x, request.odom_y, request.odom_yaw))
        self._scan = scans[-1] if scans else self._scan
        began, ended = self._trail.at(self._scan.began_ns), self._trail.at(self._scan.stamp_ns)
        turn = began.inverse() @ ended if began is not None and ended is not None else None
        points = scan_points(self._scan, self._mount, ScanPointsParams(), turn)
        self.seen = self._chain.process(stamp_ns, objects, points)
        if self.seen.found.row.valid:
            self.seconds.append(time.perf_counter() - started)
        return self.seen.found.row


def new_chain(chain: Chain, mount: LidarMount) -> RowChain:
    """A published one."""
    camera, params = robot_cameras()[CameraName.FRONT], PublishedFusionParams()
    if chain is Chain.LIDAR:
        return LidarRansac(params)
    return VisionRansac(camera, params) if chain is Chain.VISION else PublishedFusion(camera, mount, params)


def bare_view(row: RowObservation, objects: tuple[DetectedObject, ...]) -> CameraView:
    """A row and the boxes that it is of, without a picture."""
    return CameraView(
        stamp_ns=row.stamp_ns, camera=row.camera, width_px=640, height_px=360, objects=objects, points=(), left=None,
        right=None, centre=None, row=row, latency_ms=0.0,
    )  # fmt: skip
