"""What row perception asks of a detector, and what every detector does with a bad picture."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from navcore.messages import DetectedObject, ObjectKind

Image = NDArray[np.uint8]

# 1-sigma of the brightness of a picture that shows something, 0 to 255.
_CONTRAST = 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class DetectorParams:
    """Attributes:
    weights: ONNX file; empty for the shipped one.
    classes: of a YOLO model: which of its classes, counted from 0, are trunks and posts. Empty for our own network.
    threshold: least confidence, 0 to 1.
    """

    weights: str = ""
    classes: dict[ObjectKind, tuple[int, ...]] = field(default_factory=dict)
    threshold: float = 0.3


class Detector(Protocol):
    """Finds trunks and posts. The chain behind it does not care how."""

    def detect(self, image: Image) -> tuple[DetectedObject, ...]:
        """Boxes in pixels of the given picture (H, W, 3), BGR, best first."""
        ...


@dataclass(slots=True)
class Told:
    """A `Detector` that gives what it is told: what another has found, so that several chains see the same."""

    objects: tuple[DetectedObject, ...] = ()

    def detect(self, image: Image) -> tuple[DetectedObject, ...]:
        """The objects; the picture is not looked at."""
        return self.objects


def picture_fault(image: Image, *, width_px: int, height_px: int) -> str:
    """Why a picture cannot show a row: a short sentence, empty if it can.

    A picture without contrast (covered lens, no exposure, blinded by the sun) is a condition of the field.
    """
    if image.size == 0:
        return "the picture is empty"
    if image.shape != (height_px, width_px, 3) or image.dtype != np.uint8:
        return f"the picture is not {width_px}x{height_px} BGR"
    sample = image[::16, ::16].astype(np.float64).ravel()
    mean = float(sample.mean())
    if float(sample @ sample) / len(sample) - mean**2 >= _CONTRAST**2:
        return ""
    return "the picture is black" if mean < 24 else "the picture is white" if mean > 231 else "the picture is blank"
