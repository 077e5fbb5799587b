"""From the network's maps to boxes: peaks, boxes, suppression of doubles. NumPy only."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.messages import DetectedObject, ObjectKind

Singles = NDArray[np.float32]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Order of the network's classes.
KINDS = (ObjectKind.TRUNK, ObjectKind.POST)


@dataclass(frozen=True, slots=True, kw_only=True)
class DecodingParams:
    """What counts as found.

    Attributes:
        threshold: least confidence, 0 to 1.
        max_objects: best so many are kept.
        max_overlap: two boxes with a higher intersection over union are one object, 0 to 1.
        foot_distance_px, foot_distance_widths: so are two feet closer than that, or than so many widths of the wider
            box.
        across_kinds: whatever their classes; else a vine close to its post is an object of its own.
    """

    threshold: float = 0.3
    max_objects: int = 60
    max_overlap: float = 0.6
    foot_distance_px: float = 4.0
    foot_distance_widths: float = 0.5
    across_kinds: bool = False


def decode(peaks: Singles, boxes: Singles, stride: int, params: DecodingParams) -> tuple[Floats, Floats, list[int]]:
    """Boxes (N, 4), confidences (N,) and class indices, best first; network pixels.

    `peaks` (2, h, w) are probabilities at local maxima, `stride` px apart, and 0 elsewhere. `boxes` (4 or 8, h / n,
    w / n) are the foot's u and v from the cell's middle and the logarithms of width and height, in cells of
    n `stride`: for all classes alike, or first for trunks and then for posts.
    """
    kinds, rows, columns = np.nonzero(peaks >= params.threshold)
    confidence = peaks[kinds, rows, columns].astype(np.float64)
    best = np.argsort(-confidence, kind="stable")[: params.max_objects]
    kinds, confidence, finer = kinds[best], confidence[best], peaks.shape[1] // boxes.shape[1]
    rows, columns = rows[best] // finer, columns[best] // finer
    values = boxes.reshape(-1, 4, *boxes.shape[1:])
    du, dv, log_width, log_height = values[kinds % len(values), :, rows, columns].astype(np.float64).T
    half, height = np.exp(np.clip(log_width, -4, 6)) / 2, np.exp(np.clip(log_height, -4, 6))
    u, v = columns + 0.5 + du, rows + 0.5 + dv
    found = np.column_stack((u - half, v - height, u + half, v)) * (stride * finer)
    kept = suppress(found, kinds, params)
    return found[kept], confidence[kept], [int(kinds[i]) for i in kept]


def suppress(boxes: Floats, kinds: Ints, params: DecodingParams) -> list[int]:
    """Indices of the boxes (N, 4) of classes (N,), best first, that are not a double of a better one."""
    kept: list[int] = []
    dropped = np.zeros(len(boxes), dtype=np.bool_)
    alike = (kinds[:, None] == kinds) | params.across_kinds
    for i, doubles in enumerate(alike & _same(boxes[:, None], boxes, params)):
        if not dropped[i]:
            kept.append(i)
            dropped |= doubles
    return kept


def _same(others: Floats, boxes: Floats, params: DecodingParams) -> NDArray[np.bool_]:
    """Whether two boxes are one object; (..., 4) each, broadcast."""
    wider = np.maximum(others[..., 2] - others[..., 0], boxes[..., 2] - boxes[..., 0])
    du = (others[..., 0] + others[..., 2] - boxes[..., 0] - boxes[..., 2]) / 2
    near = np.maximum(params.foot_distance_px, params.foot_distance_widths * wider)
    feet = np.hypot(du, others[..., 3] - boxes[..., 3]) < near
    return np.asarray(feet | (overlap(others, boxes) > params.max_overlap))


def overlap(boxes: Floats, others: Floats) -> Floats:
    """Intersection over union of boxes with others; (..., 4) each, broadcast."""
    width = np.minimum(boxes[..., 2], others[..., 2]) - np.maximum(boxes[..., 0], others[..., 0])
    height = np.minimum(boxes[..., 3], others[..., 3]) - np.maximum(boxes[..., 1], others[..., 1])
    common = np.maximum(width, 0.0) * np.maximum(height, 0.0)
    area = _area(boxes) + _area(others)
    return np.asarray(common / np.maximum(area - common, 1e-9))


def _area(boxes: Floats) -> Floats:
    return np.asarray((boxes[..., 2] - boxes[..., 0]) * (boxes[..., 3] - boxes[..., 1]))


def detected_objects(
    boxes: Floats, confidence: Floats, kinds: list[int], *, scale: float, width_px: int, height_px: int
) -> tuple[DetectedObject, ...]:
    """Boxes of the network, `scale` times as large, cut at the picture's edges; empty ones are dropped."""
    edges = np.array((width_px, height_px, width_px, height_px), dtype=np.float64)
    cut = np.clip(boxes * scale, 0.0, edges).tolist()
    return tuple(
        DetectedObject(kind=KINDS[k], confidence=float(c), x1=float(x1), y1=float(y1), x2=float(x2), y2=float(y2))
        for (x1, y1, x2, y2), c, k in zip(cut, confidence, kinds, strict=True)
        if x2 > x1 and y2 > y1
    )
