"""Somebody else's detector: any ONNX model with the outputs of YOLOv5, 7, 8 or 11, run by ONNX Runtime."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from navcore.errors import ModelError
from navcore.messages import DetectedObject, ObjectKind
from navcore.perception.box_decoding import KINDS, DecodingParams, detected_objects, suppress
from navcore.perception.detector import Image
from navcore.perception.picture_fit import fit_picture

Singles = NDArray[np.float32]
Floats = NDArray[np.float64]

# What YOLO fills a picture up with that does not have the model's shape.
FILL = 114
USUAL_SIDE_PX = 640


@dataclass(frozen=True, slots=True, kw_only=True)
class YoloParams:
    """Attributes:
    classes: which of the model's classes, counted from 0, are trunks and posts.
    decoding: threshold and suppression.
    """

    classes: Mapping[ObjectKind, tuple[int, ...]] = field(default_factory=dict)
    decoding: DecodingParams = DecodingParams()


# As published: one trained here on trunks and posts, with YOLOv8's own idea of doubles (boxes of one class that
# overlap by 0.7, of however many objects).
PUBLISHED = YoloParams(
    classes={ObjectKind.TRUNK: (0,), ObjectKind.POST: (1,)},
    decoding=DecodingParams(max_objects=300, max_overlap=0.7, foot_distance_px=0.0, foot_distance_widths=0.0),
)


class YoloDetector:
    """A `Detector`. The layout of the output tells itself: (1, 4 + C, N) of version 8 on, (1, N, 5 + C) before."""

    def __init__(self, session: Any, name: str, params: YoloParams) -> None:
        """`name` is the model's in messages. Raises ModelError for outputs and classes that do not fit."""
        self._session, self._params = session, params
        self._input = session.get_inputs()[0].name
        self._height, self._width = _input_size(session, name)
        self._check(name)

    def detect(self, image: Image) -> tuple[DetectedObject, ...]:
        """Boxes in a picture (H, W, 3), BGR, of any size; best first."""
        height, width = image.shape[:2]
        fitted, scale = fit_picture(image, self._height, self._width)
        blob, (left, top) = self._letterbox(fitted)
        boxes, confidence, kinds = self._decoded(self._session.run(None, {self._input: blob})[0])
        boxes = boxes - (left, top, left, top)
        return detected_objects(boxes, confidence, kinds, scale=1 / scale, width_px=width, height_px=height)

    def inputs(self, image: Image) -> dict[str, Singles]:
        """What the network is given for a picture, by its input's name."""
        return {self._input: self._letterbox(fit_picture(image, self._height, self._width)[0])[0]}

    def _letterbox(self, fitted: Image) -> tuple[Singles, tuple[int, int]]:
        """The picture as YOLO wants it: red, green, blue, 0 to 1, in the middle; and where that begins."""
        h, w = fitted.shape[:2]
        left, top = (self._width - w) // 2, (self._height - h) // 2
        full = np.full((self._height, self._width, 3), FILL, dtype=np.uint8)
        full[top : top + h, left : left + w] = fitted
        blob = np.ascontiguousarray(full[..., ::-1].transpose(2, 0, 1)[None], dtype=np.float32) / np.float32(255)
        return blob, (left, top)

    def _decoded(self, output: Singles) -> tuple[Floats, Floats, list[int]]:
        """Boxes (N, 4) in the model's pixels, confidences (N,) and indices into `KINDS`, best first."""
        boxes, scores = _boxes_and_scores(output)
        per_kind = np.stack(
            [scores[:, list(self._params.classes.get(k, ()))].max(axis=1, initial=0.0) for k in KINDS]
        )
        kinds, confidence = per_kind.argmax(axis=0), per_kind.max(axis=0)
        found = np.flatnonzero((confidence >= self._params.decoding.threshold) & np.isfinite(boxes).all(axis=1))
        best = found[np.argsort(-confidence[found], kind="stable")][: 4 * self._params.decoding.max_objects]
        kept = best[suppress(boxes[best], kinds[best], self._params.decoding)][: self._params.decoding.max_objects]
        return boxes[kept], confidence[kept], [int(k) for k in kinds[kept]]

    def _check(self, name: str) -> None:
        """One look at a grey picture."""
        blob = np.full((1, 3, self._height, self._width), 0.5, dtype=np.float32)
        outputs = self._session.run(None, {self._input: blob})
        shape = np.shape(outputs[0])
        if len(shape) != 3 or shape[0] != 1 or min(shape[1:]) < 5:
            raise ModelError(f"The model {name} is no YOLO detector: its output is {shape}.")
        count = _boxes_and_scores(outputs[0])[1].shape[1]
        told = [c for classes in self._params.classes.values() for c in classes]
        if not told or not all(0 <= c < count for c in told):
            raise ModelError(
                f"Say which of the {count} classes of {name} are trunks and posts, counted from 0: "
                "[detector] classes = { trunk = [0], post = [1] }."
            )


def _boxes_and_scores(output: Singles) -> tuple[Floats, Floats]:
    """Corners (N, 4) and scores per class (N, C) of either layout."""
    rows = output[0].astype(np.float64)
    newer = rows.shape[0] < rows.shape[1]
    rows = rows.T if newer else rows
    scores = rows[:, 4:] if newer else rows[:, 4:5] * rows[:, 5:]
    middle, half = rows[:, :2], rows[:, 2:4] / 2
    return np.hstack((middle - half, middle + half)), scores


def _input_size(session: Any, name: str) -> tuple[int, int]:
    """Height and width of the input (1, 3, H, W); 640 where the model leaves them open."""
    shape = session.get_inputs()[0].shape
    if len(shape) != 4 or shape[1] not in (3, "3"):
        raise ModelError(f"The model {name} is no YOLO detector: its input is {shape}, not (1, 3, H, W).")
    height, width = (side if isinstance(side, int) else USUAL_SIDE_PX for side in shape[2:])
    return height, width
