"""Looks at a large picture whole and in overlapping slices (slicing aided inference, Akyon et al. 2022).

A network sees a picture no larger than its input: of a square photograph thin vines vanish that a slice in the
photograph's own pixels still shows. For single pictures; on the robot it would take several times as long.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from navcore.messages import DetectedObject, ObjectKind
from navcore.perception.box_decoding import DecodingParams, suppress
from navcore.perception.detector import Detector, Image


@dataclass(frozen=True, slots=True, kw_only=True)
class SlicedDetectorParams:
    """How a picture is cut.

    Attributes:
        width_px, height_px: of a slice, as the network's input; a picture that is no larger is not cut.
        overlap: least share of a slice that the next one shows too, 0 to 0.9.
        edge_px: an object that ends so near to a cut is told by the next slice.
        doubles: what counts as one object seen twice.
    """

    width_px: int = 640
    height_px: int = 384
    overlap: float = 0.25
    edge_px: float = 4.0
    doubles: DecodingParams = DecodingParams()


class SlicedDetector:
    """A `Detector` around another one."""

    def __init__(self, detector: Detector, params: SlicedDetectorParams = SlicedDetectorParams()) -> None:
        self._detector, self._params = detector, params

    def detect(self, image: Image) -> tuple[DetectedObject, ...]:
        """Boxes in pixels of the picture (H, W, 3), BGR, best first, each object once."""
        whole = self._detector.detect(image)
        places = tuple(self._places(image))
        if len(places) == 1:
            return whole
        cut = (o for place in places for o in self._in_slice(image, *place))
        return self._once(sorted((*whole, *cut), key=lambda o: -o.confidence))

    def _places(self, image: Image) -> Iterator[tuple[int, int]]:
        """Left upper corners of the slices."""
        p, (height, width) = self._params, image.shape[:2]
        for y in _starts(height, p.height_px, p.overlap):
            for x in _starts(width, p.width_px, p.overlap):
                yield x, y

    def _in_slice(self, image: Image, x: int, y: int) -> Iterator[DetectedObject]:
        """What a slice shows whole: a foot below it and sides beyond it are another's."""
        p, (height, width) = self._params, image.shape[:2]
        piece = np.ascontiguousarray(image[y : y + p.height_px, x : x + p.width_px])
        h, w = piece.shape[:2]
        left = p.edge_px if x > 0 else -1.0
        right, below = (w - p.edge_px if x + w < width else w + 1.0), (h - p.edge_px if y + h < height else h + 1.0)
        for o in self._detector.detect(piece):
            if o.x1 > left and o.x2 < right and o.y2 < below:
                yield replace(o, x1=o.x1 + x, x2=o.x2 + x, y1=o.y1 + y, y2=o.y2 + y)

    def _once(self, objects: list[DetectedObject]) -> tuple[DetectedObject, ...]:
        boxes = np.array([(o.x1, o.y1, o.x2, o.y2) for o in objects]).reshape(-1, 4)
        kinds = np.array([o.kind is ObjectKind.POST for o in objects], dtype=np.int64)
        return tuple(objects[i] for i in suppress(boxes, kinds, self._params.doubles))


def _starts(length: int, window: int, overlap: float) -> list[int]:
    """Where windows begin that cover a length, evenly spread."""
    if length <= window:
        return [0]
    count = math.ceil((length - window) / (window * (1.0 - overlap))) + 1
    return [round(i * (length - window) / (count - 1)) for i in range(count)]
