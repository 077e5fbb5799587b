"""The shipped detector: our network, run by ONNX Runtime on one thread."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import onnxruntime as ort
from numpy.typing import NDArray

from navcore.errors import ModelError
from navcore.messages import DetectedObject
from navcore.perception.box_decoding import DecodingParams, decode, detected_objects
from navcore.perception.detector import Image
from navcore.perception.picture_fit import fit_picture

WEIGHTS = Path(__file__).with_name("weights") / "feet.onnx"


@dataclass(frozen=True, slots=True, kw_only=True)
class OnnxDetectorParams:
    """Attributes:
    weights: the model; None is the shipped one.
    decoding: threshold and suppression.
    """

    weights: Path | None = None
    decoding: DecodingParams = DecodingParams()


class OnnxDetector:
    """A `Detector`. The same picture gives the same boxes; one thread, so that the robot's other core stays free."""

    def __init__(self, params: OnnxDetectorParams = OnnxDetectorParams()) -> None:
        """Raises ModelError with a sentence for a file that is missing, broken, or another model."""
        path = params.weights or WEIGHTS
        self._decoding = params.decoding
        self._session = open_model(path)
        self._input, self._height, self._width = _input_size(self._session, path)
        self._stride = _stride(self._session, self._width, path)

    def detect(self, image: Image) -> tuple[DetectedObject, ...]:
        """Boxes in a picture (H, W, 3), BGR, of any size; best first."""
        height, width = image.shape[:2]
        fitted, scale = fit_picture(image, self._height, self._width)
        peaks, boxes = self._session.run(None, {self._input: self._blob(fitted)})
        found, confidence, kinds = decode(peaks[0], boxes[0], self._stride, self._decoding)
        return detected_objects(found, confidence, kinds, scale=1 / scale, width_px=width, height_px=height)

    def inputs(self, image: Image) -> dict[str, NDArray[np.float32]]:
        """What the network is given for a picture, by its input's name."""
        return {self._input: self._blob(fit_picture(image, self._height, self._width)[0])}

    def _blob(self, fitted: Image) -> NDArray[np.float32]:
        """The picture as the network wants it: in the upper left corner, 0 to 1."""
        h, w = fitted.shape[:2]
        blob = np.empty((1, 3, self._height, self._width), dtype=np.float32)
        blob[:, :, h:], blob[:, :, :h, w:] = 0.0, 0.0
        for plane, out in zip(cv2.split(fitted), blob[0], strict=True):
            np.multiply(plane, np.float32(1 / 255), out=out[:h, :w])
        return blob


def open_model(path: Path, *, what: str = "detector", verb: str = "train") -> Any:
    """A session on one thread. Raises ModelError with a sentence for a file that is missing or broken.

    `what` the model is, and the `rowpilot` verb that trains one.
    """
    if not path.is_file():
        raise ModelError(f"There is no {what} at {path}; train one with `rowpilot {verb}` or restore the file.")
    options = ort.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.execution_mode = ort.ExecutionMode.ORT_SEQUENTIAL
    options.use_deterministic_compute = True
    options.log_severity_level = 4
    # Waiting threads must not burn the core that the control loop needs.
    options.add_session_config_entry("session.intra_op.allow_spinning", "0")
    try:
        return ort.InferenceSession(str(path), options, providers=["CPUExecutionProvider"])
    except Exception as error:  # ONNX Runtime raises classes of its own that share no base
        raise ModelError(f"The {what} {path} is damaged or no ONNX model; restore the file.") from error


def _input_size(session: Any, path: Path) -> tuple[str, int, int]:
    """Name, height and width of the only input (1, 3, H, W)."""
    inputs = session.get_inputs()
    shape = inputs[0].shape if len(inputs) == 1 else []
    if len(shape) != 4 or shape[:2] != [1, 3] or not all(isinstance(n, int) for n in shape):
        raise ModelError(f"The model {path} is no trunk and post detector: its input is {shape}, not (1, 3, H, W).")
    return str(inputs[0].name), int(shape[2]), int(shape[3])


def _stride(session: Any, width: int, path: Path) -> int:
    """Pixels from cell to cell of the peaks; those are at least as fine as the boxes."""
    shapes = [output.shape for output in session.get_outputs()]
    channels = [s[1] for s in shapes if len(s) == 4 and all(isinstance(n, int) for n in s)]
    if channels not in ([2, 4], [2, 8]) or not _finer(shapes[0][2:], shapes[1][2:]):
        raise ModelError(f"The model {path} is no trunk and post detector: its outputs are {shapes}.")
    return width // int(shapes[0][3])


def _finer(fine: list[int], coarse: list[int]) -> bool:
    """Whether a map of that size (h, w) has the same whole number of cells for each of the other's, both ways."""
    times = fine[0] // coarse[0]
    return times >= 1 and [times * n for n in coarse] == list(fine)
