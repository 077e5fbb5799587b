"""Row perception: from a picture to the row ahead (paper A, 2.3.2). `RowPerception.process` is the block diagram."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from navcore.geometry.pinhole import PinholeCamera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, CameraView, DetectedObject
from navcore.perception.camera_view import camera_view, row_observation
from navcore.perception.corner_points import CornerPoints, corner_points
from navcore.perception.corridor_track import CorridorTrackerParams
from navcore.perception.corridor_tracker import CorridorTracker
from navcore.perception.detector import Detector, Image, picture_fault
from navcore.perception.geometric_filter import GeometricFilterParams, geometric_filter
from navcore.perception.ground_row import GroundRowParams, ground_row
from navcore.perception.image_lines import driving_camera, image_bisector, looks_back, published_reading
from navcore.perception.lean_watch import LeanWatch, LeanWatchParams, Reading
from navcore.perception.least_squares import LeastSquares
from navcore.perception.row_bands import filter_region
from navcore.perception.row_end import RowEnd, RowEndParams, seen_to
from navcore.perception.row_lines import GroundRow, RowCue, RowLineFitter, RowLines, RowPrior
from navcore.perception.row_odometry import RowOdometry, RowOdometryParams
from navcore.perception.row_ransac import Ransac, RansacParams
from navcore.perception.temporal_ransac import SlopeCheckParams, TemporalRansac


class RowMethod(StrEnum):
    """How the row's lines are fitted: paper A's three methods, and ours on the ground."""

    LEAST_SQUARES = "least_squares"
    RANSAC = "ransac"
    TEMPORAL_RANSAC = "temporal_ransac"
    CORRIDOR = "corridor"


@dataclass(frozen=True, slots=True, kw_only=True)
class RowPerceptionParams:
    """Every stage's own values.

    Attributes:
        method: of the line fit.
        look_ahead: Z_p of the published lateral deviation, m (paper A: 0.9 to 1.1 in the row).
        min_confidence: boxes below are not used, 0 to 1.
        filter: k1 to k5.
    """

    method: RowMethod = RowMethod.CORRIDOR
    look_ahead: float = 1.0
    min_confidence: float = 0.0
    filter: GeometricFilterParams = GeometricFilterParams()
    ransac: RansacParams = RansacParams()
    slope_check: SlopeCheckParams = SlopeCheckParams()
    ground: GroundRowParams = GroundRowParams()
    corridor: CorridorTrackerParams = CorridorTrackerParams()
    row_end: RowEndParams = RowEndParams()
    lean: LeanWatchParams = LeanWatchParams()
    odometry: RowOdometryParams = RowOdometryParams()


def row_line_fitter(camera: PinholeCamera, params: RowPerceptionParams) -> RowLineFitter:
    """The fitter that `params.method` names. `camera` is mounted in the driving frame."""
    if params.method is RowMethod.CORRIDOR:
        return CorridorTracker(camera, params.corridor)
    if params.method is RowMethod.LEAST_SQUARES:
        return LeastSquares()
    ransac = Ransac(params.ransac, width_px=camera.width_px)
    return ransac if params.method is RowMethod.RANSAC else TemporalRansac(ransac, camera, params.slope_check)


class RowPerception:
    """Looks for the row in the pictures of one camera. Feed it every picture in order, or `forget` in between."""

    def __init__(self, camera: PinholeCamera, detector: Detector, params: RowPerceptionParams) -> None:
        """`camera` is mounted in `base_link`, at the front or at the rear."""
        self._backwards = looks_back(camera)
        self._camera = driving_camera(camera)
        self._detector = detector
        self._params = params
        self._fitter = row_line_fitter(self._camera, params)
        self._end = RowEnd(params.row_end)
        self._lean = LeanWatch(self._camera, params.lean)
        self._odometry = RowOdometry(camera.z, params.odometry)
        c = self._camera
        self._region = filter_region(params.filter, width_px=c.width_px, height_px=c.height_px)

    def process(
        self, image: Image, stamp_ns: int, camera_name: CameraName, *, prior: RowPrior | None = None,
        motion: SE2 | None = None, latency_ms: float = 0.0,
    ) -> CameraView:  # fmt: skip
        """What is seen in one picture (H, W, 3), BGR.

        `motion` is the pose of `base_link` at this picture in `base_link` at the last one (`T_last_now`, from
        odometry); without it nothing of earlier pictures is used. `prior` is in the driving frame.
        """
        cue = RowCue(prior=prior, motion=self._driven(motion))
        fault = self._fault(image)
        objects = () if fault else self._detector.detect(image)
        corners = self._corner_points(objects)
        lines = self._fitter.fit(corners, cue)
        ground = self._on_ground(lines, corners)
        bisector = image_bisector(lines.left, lines.right) if lines.left and lines.right else None
        published = published_reading(bisector, self._camera, self._params.look_ahead) if bisector else None
        seen = None if isinstance(ground, str) or ground.carried else ground
        reading = self._read_lean(seen, cue)
        driven = self._odometry.see(seen, cue.motion, stamp_ns)
        end = self._row_end(seen, cue.motion)
        row = row_observation(
            stamp_ns, camera_name, lines, fault or ground, end, self._seen_to(ground), published, reading, driven
        )  # fmt: skip
        return camera_view(self._camera, objects, corners, lines, ground, bisector, row, latency_ms, self._region)

    def _read_lean(self, row: GroundRow | None, cue: RowCue) -> Reading | None:
        roll, pitch = (cue.prior.roll, cue.prior.pitch or 0.0) if cue.prior else (0.0, 0.0)
        return self._lean.see(row, cue.motion, told_roll=roll, told_pitch=pitch)

    def forget(self) -> None:
        """The next picture does not follow the last one."""
        self._fitter.forget()
        self._end.forget()
        self._lean.forget()
        self._odometry.forget()

    def _fault(self, image: Image) -> str:
        return picture_fault(image, width_px=self._camera.width_px, height_px=self._camera.height_px)

    def _driven(self, motion: SE2 | None) -> SE2 | None:
        """The motion of the driving frame."""
        return SE2(-motion.x, -motion.y, motion.yaw) if motion is not None and self._backwards else motion

    def _corner_points(self, objects: tuple[DetectedObject, ...]) -> CornerPoints:
        sure = [o for o in objects if o.confidence >= self._params.min_confidence]
        corners, c = corner_points(sure, self._camera.width_px, self._camera.height_px), self._camera
        mask = geometric_filter(
            corners.points, width_px=c.width_px, height_px=c.height_px, params=self._params.filter
        )  # fmt: skip
        return corners.only(mask)

    def _on_ground(self, lines: RowLines, corners: CornerPoints) -> GroundRow | str:
        """The corridor on the ground, or why there is none."""
        return lines.reason or lines.ground or ground_row(lines, corners, self._camera, self._params.ground)

    def _row_end(self, row: GroundRow | None, motion: SE2 | None) -> float | None:
        """By the plants the robot got so far since the last picture, and by the wheels where no row is seen."""
        if motion is None:
            self._end.forget()
        told = motion.x if motion else 0.0
        return self._end.update(row, self._odometry.step if row and motion else told)

    def _seen_to(self, ground: GroundRow | str) -> float | None:
        if isinstance(ground, str):
            return None
        return seen_to(np.concatenate((ground.left_x, ground.right_x)), self._params.row_end)
