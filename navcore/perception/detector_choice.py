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
    weights = Path(params.weights) if params.weights else None
    if weights is None or not (params.classes or len(open_model(weights).get_outputs()) == 1):
        return OnnxDetector(OnnxDetectorParams(weights=weights, decoding=decoding))
    return YoloDetector(open_model(weights), str(weights), YoloParams(classes=params.classes, decoding=decoding))
