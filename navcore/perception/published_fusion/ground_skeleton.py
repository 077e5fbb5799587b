"""Paper B's rival with segmentation: from the mask of the ground to its centre line in the mask, as published."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.errors import ConfigError, ContractError
from navcore.perception.published_fusion.point_ransac import PointRansac, PointRansacParams
from navcore.perception.published_fusion.thinning_kernels import thin

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

NO_GROUND = "no ground of a row in the picture"
BROKEN = "the ground in the picture has no clear middle"


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundSkeletonParams:
    """The paper names the steps and gives no values.

    Attributes:
        opening_px, closing_px: diameter of the round brush that takes specks away, and of the one that fills holes,
            in pixels of the mask, 160 on each side.
        raster: width and height that the mask is drawn to before it is thinned, px. Ours: before a wide lens a
            corridor opens by more than a right angle, and thinning wears such a wedge off from its tip; drawn narrow
            it keeps its middle.
        min_ground, max_ground: less, or more, of the mask is no row ahead, shares, 0 to 1.
        ransac: of the skeleton's pixels, its `distance` in pixels of the raster.
        min_rows: the pixels on the line must reach over so many rows of the raster.
    """

    opening_px: int = 5
    closing_px: int = 9
    raster: tuple[int, int] = (80, 240)
    min_ground: float = 0.02
    max_ground: float = 0.7
    ransac: PointRansacParams = PointRansacParams(distance=1.0)
    min_rows: int = 25

    def __post_init__(self) -> None:
        if min(self.opening_px, self.closing_px, self.min_rows, *self.raster) < 1:
            raise ConfigError("The skeleton needs brushes, a raster and rows of 1 px or more.")
        if not 0.0 < self.min_ground < self.max_ground < 1.0:
            raise ConfigError("The skeleton needs shares of ground between 0 and 1, the lesser one first.")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MaskLine:
    """The centre line in the picture, or why there is none; places are u and v as shares of its width and height.

    Attributes:
        reason: a short sentence; empty where there is a line.
        skeleton: (N, 2) its pixels' middles. kept: (N,) which lie on the line.
        ends: (2, 2) the line at the lowest and at the highest of them; None without a line.
    """

    reason: str
    skeleton: Floats
    kept: Mask
    ends: Floats | None = None


def mask_line(mask: Mask, params: GroundSkeletonParams) -> MaskLine:
    """Opening, closing, Guo-Hall thinning, RANSAC.

    Raises ContractError for what is no mask (H, W) of truth values.
    """
    if mask.ndim != 2 or mask.dtype != np.bool_:
        raise ContractError(f"A mask of the ground is (H, W) of truth values, not {mask.shape} of {mask.dtype}.")
    ground, raster = cleaned(mask, params), np.array(params.raster)
    pixels = skeleton(ground, params.raster) if ground.mean() <= params.max_ground else np.empty((0, 2))
    nowhere = np.zeros(len(pixels), dtype=np.bool_)
    if ground.mean() < params.min_ground:
        return MaskLine(reason=NO_GROUND, skeleton=pixels / raster, kept=nowhere)
    found = PointRansac(params.ransac).fit(pixels, np.ones(len(pixels)))
    kept = nowhere if found is None else found.inliers
    if found is None or np.ptp(pixels[kept, 1]) < params.min_rows:
        return MaskLine(reason=BROKEN, skeleton=pixels / raster, kept=kept)
    on = pixels[kept]
    ends = np.array([found.line.project(*on[k]) for k in (on[:, 1].argmax(), on[:, 1].argmin())]) / raster
    return MaskLine(reason="", skeleton=pixels / raster, kept=kept, ends=ends)


def cleaned(mask: Mask, params: GroundSkeletonParams) -> Mask:
    """Specks taken away, then holes filled."""
    ground = mask.astype(np.uint8)
    for step, size in ((cv2.MORPH_OPEN, params.opening_px), (cv2.MORPH_CLOSE, params.closing_px)):
        brush = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size))
        ground = np.asarray(cv2.morphologyEx(ground, step, brush), dtype=np.uint8)
    return ground > 0


def skeleton(mask: Mask, raster: tuple[int, int]) -> Floats:
    """Middles (N, 2), u and v, of the pixels that thinning leaves of the mask drawn to `raster`, width and height."""
    drawn = cv2.resize(mask.astype(np.float32), raster, interpolation=cv2.INTER_LINEAR) >= 0.5
    rows, columns = np.nonzero(thin(drawn.astype(np.uint8)))
    return np.column_stack((columns + 0.5, rows + 0.5))
