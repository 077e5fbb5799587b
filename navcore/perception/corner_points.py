"""Corner points: where the detected objects meet the ground (paper A, 2.3.2, 3, step 1)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.messages import DetectedObject

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CornerPoints:
    """One point per detected object, pixels.

    Attributes:
        points: (N, 2) u, v of the lower corner that faces the corridor.
        feet: (N, 2) u, v of the middle of the box's lower edge; NaN where the picture's edge cuts the box, because
            then that is not where the object stands.
        left: (N,) True if the object stands left of the image's vertical centre line.
    """

    points: Floats
    feet: Floats
    left: Mask

    def __len__(self) -> int:
        return len(self.points)

    def only(self, mask: Mask) -> CornerPoints:
        """The points for which `mask` (N,) is True."""
        return CornerPoints(points=self.points[mask], feet=self.feet[mask], left=self.left[mask])


def corner_points(objects: Sequence[DetectedObject], width_px: int, height_px: int) -> CornerPoints:
    """Lower right corners of boxes in the left half of the image, lower left corners of those in the right half."""
    boxes = np.array([(o.x1, o.y1, o.x2, o.y2) for o in objects], dtype=np.float64).reshape(-1, 4)
    middle = (boxes[:, 0] + boxes[:, 2]) / 2
    left = middle < width_px / 2
    cut = (boxes[:, 0] < 1.0) | (boxes[:, 2] > width_px - 1.0) | (boxes[:, 3] > height_px - 1.0)
    return CornerPoints(
        points=np.column_stack((np.where(left, boxes[:, 2], boxes[:, 0]), boxes[:, 3])),
        feet=np.where(cut[:, None], np.nan, np.column_stack((middle, boxes[:, 3]))),
        left=left,
    )
