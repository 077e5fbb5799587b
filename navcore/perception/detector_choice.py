"""The detector that the settings name: the shipped one, one trained with `rowpilot train`, or any YOLO."""

from __future__ import annotations

from pathlib import Path

from navcore.perception.box_decoding import DecodingParams
from navcore.perception.detector import Detector, DetectorParams
from navcore.perception.onnx_detector import OnnxDetector, OnnxDetectorParams, open_model
from navcore.perception.yolo_detector import YoloDetector, YoloParams


def new_detector(params: DetectorParams) -> Detector:
    """Raises ModelError with a sentence for a file that is missing, broken, or of another kind."""
    decoding = DecodingParams(threshold=params.threshold)
    if not params.weights:
        return OnnxDetector(OnnxDetectorParams(decoding=decoding))
    weights = Path(params.weights)
    session = open_model(weights)
    if params.classes or len(session.get_outputs()) == 1:
        return YoloDetector(session, params.weights, YoloParams(classes=params.classes, decoding=decoding))
    return OnnxDetector(OnnxDetectorParams(weights=weights, decoding=decoding))
