"""Paper B's third rival: segmented ground, its skeleton, RANSAC in the picture, the line laid onto the ground."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import ContractError, InputError
from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import CameraName, RowObservation
from navcore.perception.detector import Image
from navcore.perception.image_lines import driving_camera, looks_back
from navcore.perception.published_fusion.ground_segmenter import Segmenter
from navcore.perception.published_fusion.ground_skeleton import BROKEN, GroundSkeletonParams, MaskLine, mask_line
from navcore.perception.published_fusion.published_chain import PublishedView
from navcore.perception.published_fusion.published_rows import PublishedRow
from navcore.perception.published_fusion.row_kalman import RowKalman, RowKalmanParams

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class SkeletonChainParams:
    """Attributes:
    skeleton: from the mask to the line in it.
    kalman: of the line on the ground. Not in the paper; the other rivals have it, so only the eye differs.
    offset_std, heading_std_deg: 1-sigma told for a row, m and deg; as of the others.
    """

    skeleton: GroundSkeletonParams = GroundSkeletonParams()
    kalman: RowKalmanParams = RowKalmanParams()
    offset_std: float = 0.10
    heading_std_deg: float = 3.0


class SegmentationSkeleton:
    """Camera alone, flat ground. It tells neither the row's width nor its end, as published.

    Where a wide corridor leaves the picture on one side, the skeleton bends that way, and RANSAC may take the bend
    for the row: in 2 of 100 drawn masks of corridors 2 to 3 m wide, from within 0.3 m and 5 deg of their middle.
    """

    def __init__(self, camera: PinholeCamera, segmenter: Segmenter, params: SkeletonChainParams) -> None:
        """`camera` is mounted in `base_link`."""
        self._camera, self._segmenter, self._params = driving_camera(camera), segmenter, params
        self._name = CameraName.REAR if looks_back(camera) else CameraName.FRONT
        self._kalman = RowKalman(params.kalman)

    def process(self, stamp_ns: int, image: Image) -> PublishedView:
        """The row at `stamp_ns` in an undistorted picture (H, W, 3), BGR. Raises ContractError for another one.

        The view's points are the skeleton's pixels as they lie on the ground.
        """
        c = self._camera
        if image.shape != (c.height_px, c.width_px, 3):
            raise ContractError(f"The camera's pictures are {c.height_px} x {c.width_px} x 3, not {image.shape}.")
        found = mask_line(self._segmenter.segment(image), self._params.skeleton)
        line, reason = self._line(found)
        row = self._row(stamp_ns, self._kalman.update(line), line is not None, reason)
        return PublishedView(
            found=self._seen(row, found), scan=np.empty((0, 2)), labels=np.empty(0, dtype=np.int64)
        )  # fmt: skip

    def forget(self) -> None:
        """The next picture is of another place."""
        self._kalman.forget()

    def _on_ground(self, places: Floats) -> Floats:
        """Points (N, 2) in the driving frame of places (N, 2), shares of the picture; NaN above the horizon."""
        return self._camera.ground(places * (self._camera.width_px, self._camera.height_px))

    def _line(self, found: MaskLine) -> tuple[Line2 | None, str]:
        """The centre line on the ground, directed ahead, or why there is none."""
        if found.ends is None:
            return None, found.reason
        near, far = self._on_ground(found.ends).tolist()
        try:
            return Line2.through((near[0], near[1]), (far[0], far[1])), ""
        except InputError:
            return None, BROKEN

    def _seen(self, row: RowObservation, found: MaskLine) -> PublishedRow:
        points = self._on_ground(found.skeleton)
        below = np.isfinite(points).all(axis=1)
        return PublishedRow(
            row=row, left=None, right=None, points=points[below], on_left=points[below, 1] > 0.0,
            kept=found.kept[below],
        )  # fmt: skip

    def _row(self, stamp_ns: int, centre: Line2 | None, seen: bool, reason: str) -> RowObservation:
        p = self._params
        if centre is None:
            return RowObservation(stamp_ns=stamp_ns, camera=self._name, valid=False, reason=reason)
        return RowObservation(
            stamp_ns=stamp_ns, camera=self._name, valid=True, reason="", offset=centre.offset, heading=centre.heading,
            offset_std=p.offset_std, heading_std=math.radians(p.heading_std_deg), quality=0.7 * seen,
            left_seen=seen, right_seen=seen,
        )  # fmt: skip
