"""Feeds row perception what it needs beside the picture: the camera, the row that is meant, the motion in between."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.pinhole import PinholeCamera
from navcore.geometry.se2 import SE2
from navcore.messages import (
    USUAL_WIDTH,
    CameraName,
    CameraRequest,
    CameraView,
    LidarScan,
    RowObservation,
    RowSource,
)
from navcore.perception import drawing_kernels as drawing
from navcore.perception.camera_view import told_plants
from navcore.perception.detector import Image
from navcore.perception.image_lines import driving_camera
from navcore.perception.levelling import leaning_offset, levelled
from navcore.perception.plants.box_association import should_be_seen
from navcore.perception.plants.mount_watch import MountWatch
from navcore.perception.plants.odometry_trail import OdometryTrail
from navcore.perception.plants.scan_eye import ScanEye
from navcore.perception.plants.scanned_plants import ScannedPlants
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowPerception
from navcore.perception.seen_row import SeenRow

LEAST_PRIOR_STD = 0.15
WRONG_ROW = 0.38


class RowEye:
    """One perception a camera; a change of camera starts anew. A 2D LiDAR, if there is one, serves all cameras."""

    def __init__(
        self, perceptions: Mapping[CameraName, RowPerception], cameras: Mapping[CameraName, PinholeCamera],
        scan_eye: ScanEye | None = None,
    ) -> None:  # fmt: skip
        """`cameras` tell where each is mounted in `base_link`."""
        self._perceptions, self._scan_eye = perceptions, scan_eye
        self._cameras = {name: driving_camera(camera) for name, camera in cameras.items()}
        self._watches = {name: MountWatch(camera) for name, camera in self._cameras.items()} if scan_eye else {}
        self._last: CameraRequest | None = None
        self._trail = OdometryTrail()

    def look(
        self, image: Image | None, stamp_ns: int, request: CameraRequest, latency_ms: float = 0.0,
        scans: tuple[LidarScan, ...] = (),
    ) -> CameraView:  # fmt: skip
        """What `observe` sees, with all that is drawn."""
        return self.drawn(self.observe(image, stamp_ns, request, scans), latency_ms)

    def observe(
        self, image: Image | None, stamp_ns: int, request: CameraRequest, scans: tuple[LidarScan, ...] = ()
    ) -> SeenRow:
        """The row in one picture (H, W, 3) BGR of the camera that was asked for and in the scans since the last one.

        Without a picture the scans alone show the row.
        """
        perception, camera = self._perceptions[request.camera], self._cameras[request.camera]
        motion = self._motion(request)
        if motion is None:
            perception.forget()
        self._last = request
        prior, plants = row_prior(request, camera.z), self._plants(stamp_ns, request, scans)
        seen = perception.observe(image, stamp_ns, request.camera, prior=prior, motion=motion, plants=plants)
        if _is_another_row(seen.row, prior):
            perception.forget()
        self._tell(seen, camera)
        row = levelled(seen.row, camera.z, request.roll)
        row = replace(row, missing=row.missing or self._missing(request, plants))
        return seen._replace(row=row if plants is None else self._checked(row, seen))

    def drawn(self, seen: SeenRow, latency_ms: float = 0.0) -> CameraView:
        """What was seen last, for whoever looks on."""
        view = self._perceptions[seen.row.camera].drawn(seen, latency_ms)
        return self._with_scan(view, seen.row.camera) if seen.look.scanned else view

    def _plants(self, stamp_ns: int, request: CameraRequest, scans: tuple[LidarScan, ...]) -> ScannedPlants | None:
        """Scanned plants in the driving frame, None without a LiDAR that sees.

        Nor where no row is expected: nobody tells then how the robot moves.
        """
        if self._scan_eye is None or request.offset is None:
            return None
        self._trail.add(request.stamp_ns, _odom(request))
        for scan in scans:
            self._scan_eye.take(scan, self._trail)
        found = self._scan_eye.plants(stamp_ns, self._trail)
        if found is None or request.camera is CameraName.FRONT:
            return found
        return found.seen_from(_driving_frame(request.camera))

    def _checked(self, row: RowObservation, seen: SeenRow) -> RowObservation:
        """With what its trunks say of the camera's mount."""
        watch = self._watches.get(row.camera)
        if watch is None:
            return row
        boxed, numbers = told_plants(seen, seen.look.boxed), seen.look.plants.number.tolist()
        agreement = watch.see(row.stamp_ns, numbers, boxed, seen.bearings)
        return replace(row, agreement=agreement) if agreement else row

    def _with_scan(self, view: CameraView, camera: CameraName) -> CameraView:
        """With the ends of the newest scan's rays, for drawing: in the picture and from above."""
        if self._scan_eye is None:
            return view
        mount, (ends, pose) = self._cameras[camera], self._scan_eye.ends(view.stamp_ns, self._trail)
        seen = _driving_frame(camera) @ pose
        pixels, above = drawing.scan(
            ends, (seen.x, seen.y, seen.yaw), mount.compiled(), mount.width_px, mount.height_px
        )  # fmt: skip
        return replace(view, scan=_pairs(pixels), ends=_pairs(above))

    def _tell(self, seen: SeenRow, camera: PinholeCamera) -> None:
        """What the picture makes of the plants, if there is one."""
        if self._scan_eye is not None and seen.row.source is RowSource.FUSED:
            plants = seen.look.plants
            self._scan_eye.told(plants.number[seen.look.boxed], plants.number[should_be_seen(plants, camera)])

    def _missing(self, request: CameraRequest, plants: ScannedPlants | None) -> str:
        """What is wrong with the LiDAR where a row is expected."""
        if self._scan_eye is None or plants is not None or request.offset is None:
            return ""
        return self._scan_eye.problem

    def _motion(self, request: CameraRequest) -> SE2 | None:
        """`T_last_now` of base_link, None where this picture does not follow the last one.

        Nor does it where no row is expected: nobody tells then how the robot moves.
        """
        last = self._last
        if last is None or last.camera is not request.camera or request.offset is None:
            return None
        return _odom(last).inverse() @ _odom(request)


def row_prior(request: CameraRequest, camera_height: float) -> RowPrior | None:
    """The expected row in the driving frame as the leaning camera should see it, None where none is expected."""
    if request.offset is None or request.heading is None:
        return None
    std = max(request.offset_std or 0.0, LEAST_PRIOR_STD)
    offset = leaning_offset(request.offset, request.width or USUAL_WIDTH, camera_height, request.roll)
    return RowPrior(
        offset=offset, heading=request.heading, std=std, width=request.width, pitch=request.pitch, roll=request.roll,
        land_roll=request.land_roll,
    )  # fmt: skip


def _is_another_row(seen: RowObservation, prior: RowPrior | None) -> bool:
    """A line further from the expected one than a share of the width is not worth following on."""
    if prior is None or not seen.valid or seen.offset is None:
        return False
    return abs(seen.offset - prior.offset) > WRONG_ROW * (prior.width or USUAL_WIDTH)


def _pairs(points: NDArray[np.float64]) -> tuple[tuple[float, float], ...]:
    """Points (N, 2) for a message."""
    return tuple(zip(*points.T.tolist(), strict=True))


def _driving_frame(camera: CameraName) -> SE2:
    """`base_link` as seen from it."""
    return SE2(0.0, 0.0, math.pi) if camera is CameraName.REAR else SE2()


def _odom(request: CameraRequest) -> SE2:
    return SE2(request.odom_x, request.odom_y, request.odom_yaw)
