"""Which ground a picture shows between the two lines of trees: a small net of our own in place of DeepLab v3+.

The net sees the whole picture squeezed to a square, as paper B's does (640 x 640 there).
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any, Protocol

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.errors import ConfigError, ModelError
from navcore.perception.detector import Image
from navcore.perception.onnx_detector import open_model

Mask = NDArray[np.bool_]
Singles = NDArray[np.float32]

WEIGHTS = Path(__file__).parents[1] / "weights" / "ground.onnx"
SIDE_PX = 160


class Segmenter(Protocol):
    """From a picture to the ground in it."""

    def segment(self, image: Image) -> Mask:
        """(S, S) where a picture (H, W, 3), BGR, shows the corridor's ground, the picture squeezed to a square."""
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundSegmenterParams:
    """Attributes:
    weights: the model; None is the shipped one.
    threshold: ground is what is more probable than so, 0 to 1.
    """

    weights: Path | None = None
    threshold: float = 0.5

    def __post_init__(self) -> None:
        if not 0.0 < self.threshold < 1.0:
            raise ConfigError("The segmentation's threshold must lie between 0 and 1.")


class GroundSegmenter:
    """A `Segmenter`: the net run by ONNX Runtime on one thread."""

    def __init__(self, params: GroundSegmenterParams = GroundSegmenterParams()) -> None:
        """Raises ModelError with a sentence for a file that is missing, broken, or another model."""
        path = params.weights or WEIGHTS
        self._threshold = np.float32(params.threshold)
        self._session = open_model(path, what="ground segmentation", verb="train-ground")
        self._input = _input_name(self._session, path)

    def segment(self, image: Image) -> Mask:
        """See `Segmenter`."""
        (probability,) = self._session.run(None, {self._input: blob(squeezed(image))[None]})
        return np.asarray(probability[0, 0] > self._threshold)


def squeezed(image: Image) -> Image:
    """A picture (H, W, 3) as a square (S, S, 3)."""
    return np.asarray(cv2.resize(image, (SIDE_PX, SIDE_PX), interpolation=cv2.INTER_AREA), dtype=np.uint8)


def blob(square: Image) -> Singles:
    """(3, S, S), 0 to 1, as the net wants it."""
    return np.ascontiguousarray(square.transpose(2, 0, 1), dtype=np.float32) / np.float32(255.0)


def _input_name(session: Any, path: Path) -> str:
    """Of the only input (1, 3, S, S), if there is one output (1, 1, S, S)."""
    inputs, outputs = session.get_inputs(), session.get_outputs()
    shapes = [end.shape for end in (*inputs, *outputs)]
    if len(inputs) != 1 or shapes != [[1, 3, SIDE_PX, SIDE_PX], [1, 1, SIDE_PX, SIDE_PX]]:
        raise ModelError(f"The model {path} is no ground segmentation: it goes from and to {shapes}.")
    return str(inputs[0].name)
