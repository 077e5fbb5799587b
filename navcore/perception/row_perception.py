"""Row perception: from a picture to the row ahead (paper A, 2.3.2). `RowPerception.process` is the block diagram."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.pinhole import PinholeCamera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, CameraView, DetectedObject
from navcore.perception.camera_view import camera_view, plants_of_row, row_observation
from navcore.perception.corner_points import CornerPoints, corner_points
from navcore.perception.corridor_kernels import SURE
from navcore.perception.corridor_track import CorridorTrackerParams
from navcore.perception.corridor_tracker import CorridorTracker
from navcore.perception.detector import Detector, Image, picture_fault
from navcore.perception.geometric_filter import GeometricFilterParams, geometric_filter
from navcore.perception.ground_row import GroundRowParams, ground_row
from navcore.perception.image_lines import driving_camera, image_bisector, looks_back, published_reading
from navcore.perception.lean_watch import LeanWatch, LeanWatchParams, Reading
from navcore.perception.least_squares import LeastSquares
from navcore.perception.levelling import leaning_exactly, leaning_plants, level_plants, upright_offset
from navcore.perception.one_per_foot import one_per_foot
from navcore.perception.plants.bending_row import BendingRow, BendingRowParams
from navcore.perception.plants.box_association import BoxAssociationParams, associate, corners_of, slopes
from navcore.perception.plants.scanned_plants import ScannedPlants, no_plants
from navcore.perception.row_bands import filter_region
from navcore.perception.row_end import RowEnd, RowEndParams, seen_to
from navcore.perception.row_lines import GroundRow, RowCue, RowLineFitter, RowLines, RowPrior
from navcore.perception.row_odometry import RowOdometry, RowOdometryParams
from navcore.perception.row_ransac import Ransac, RansacParams
from navcore.perception.scan_evidence import ScanEvidence
from navcore.perception.seen_row import Look, SeenRow
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
    association: BoxAssociationParams = BoxAssociationParams()
    bending: BendingRowParams = BendingRowParams()


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
        self._bending = BendingRow(params.bending)
        c = self._camera
        self._region = filter_region(params.filter, width_px=c.width_px, height_px=c.height_px)

    def process(
        self, image: Image | None, stamp_ns: int, camera_name: CameraName, *, prior: RowPrior | None = None,
        motion: SE2 | None = None, latency_ms: float = 0.0, plants: ScannedPlants | None = None,
    ) -> CameraView:  # fmt: skip
        """What is seen in one picture, see `observe`, with all that is drawn over it."""
        seen = self.observe(image, stamp_ns, camera_name, prior=prior, motion=motion, plants=plants)
        return self.drawn(seen, latency_ms)

    def observe(
        self, image: Image | None, stamp_ns: int, camera_name: CameraName, *, prior: RowPrior | None = None,
        motion: SE2 | None = None, plants: ScannedPlants | None = None,
    ) -> SeenRow:  # fmt: skip
        """The row in one picture (H, W, 3), BGR, or without one by scanned plants alone.

        `motion` is the pose of `base_link` at this picture in `base_link` at the last one (`T_last_now`, from
        odometry); without it nothing of earlier pictures is used. `prior` and `plants` are in the driving frame.
        """
        look = self._look(image, plants, prior)
        cue = RowCue(prior=prior, motion=self._driven(motion), scan=look.scan)
        lines = self._fitter.fit(look.corners, cue)
        ground = self._on_ground(lines, look.corners)
        bisector = image_bisector(lines.left, lines.right) if lines.left and lines.right else None
        published = published_reading(bisector, self._camera, self._params.look_ahead) if bisector else None
        told = None if isinstance(ground, str) or ground.carried else ground
        reading = self._read_lean(told, cue)
        driven = self._odometry.see(told, cue.motion, stamp_ns)
        end = self._row_end(told, cue.motion)
        ground = self._by_scan(ground, look, prior.roll if prior else 0.0)
        shown = ground if look.scan else look.fault or ground
        row = row_observation(
            stamp_ns, camera_name, lines, shown, end, self._seen_to(ground), published, reading, driven
        )  # fmt: skip
        row = replace(row, source=look.source, missing=look.fault if look.scan else "")
        bearings = np.arctan(slopes(corners_of(look.objects), self._camera, 0.0)) if look.scan else np.empty(0)
        seen = SeenRow(row, look, lines, ground, bisector, bearings)
        return seen._replace(row=replace(row, plants=plants_of_row(seen))) if row.in_sight else seen

    def drawn(self, seen: SeenRow, latency_ms: float = 0.0) -> CameraView:
        """What was seen, as it is drawn."""
        return camera_view(self._camera, seen, latency_ms, self._region)

    def _look(self, image: Image | None, scanned: ScannedPlants | None, prior: RowPrior | None) -> Look:
        fault = self._fault(image) if image is not None else "the camera gives no picture"
        objects = () if fault or image is None else self._detector.detect(image)
        plants = no_plants() if scanned is None else scanned
        roll, pitch, land = (prior.roll, prior.pitch or 0.0, prior.land_roll) if prior else (0.0, 0.0, 0.0)
        # Boxes reach about as high as the scan: one body carries both sensors, however it leans.
        single, found = one_per_foot(objects, self._camera.width_px), np.full(len(objects), -1, dtype=np.int64)
        told = tuple(objects[i] for i in single)
        found[single] = associate(told, plants, self._camera, pitch, self._params.association)
        # A picture and a scan go into one fit: both as the leaning camera sees them.
        leaning = leaning_plants(plants, self._camera.z, roll, land)
        corners, used = self._corner_points(objects, single)
        scan = ScanEvidence(plants=leaning.evidence(), paired=found[used]) if len(plants) else None
        level = level_plants(plants, roll, land).evidence()
        return Look(fault, objects, corners, scanned is not None, plants, found, scan, level)

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

    def _corner_points(
        self, objects: tuple[DetectedObject, ...], single: NDArray[np.int64]
    ) -> tuple[CornerPoints, NDArray[np.int64]]:
        """Those that count, and which objects they are of."""
        c, least = self._camera, self._params.min_confidence
        sure = np.array([i for i in single if objects[i].confidence >= least], dtype=np.int64)
        corners = corner_points([objects[i] for i in sure], c.width_px, c.height_px)
        mask = geometric_filter(
            corners.points, width_px=c.width_px, height_px=c.height_px, params=self._params.filter
        )  # fmt: skip
        return corners.only(mask), sure[mask]

    def _on_ground(self, lines: RowLines, corners: CornerPoints) -> GroundRow | str:
        """The corridor on the ground, or why there is none."""
        return lines.reason or lines.ground or ground_row(lines, corners, self._camera, self._params.ground)

    def _by_scan(self, ground: GroundRow | str, seen: Look, roll: float) -> GroundRow | str:
        """The corridor as the scanned plants on its lines tell it, who know better where its middle runs.

        They are laid through as they stand on the ground: seen by a leaning camera, far lines are bent aside.
        """
        if seen.scan is None or isinstance(ground, str) or ground.carried:
            return ground
        z, sure = self._camera.z, seen.level[seen.level[:, 3] >= SURE]
        upright = upright_offset(ground.offset, ground.width, z, roll)
        middle = self._bending.fit(upright, ground.heading, ground.width, sure)
        if middle is None:
            return ground
        leaning = leaning_exactly(middle.offset, middle.width, z, roll)
        return replace(ground, **middle._replace(offset=leaning)._asdict())

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
