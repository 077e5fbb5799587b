"""A detector's file as it is scored: whatever it holds, run as the robot runs it, but with a low threshold."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from navcore.perception.box_decoding import DecodingParams
from navcore.perception.onnx_detector import WEIGHTS, OnnxDetector, OnnxDetectorParams, open_model
from navcore.perception.yolo_detector import PUBLISHED, YoloDetector, YoloParams
from navcore.training.evaluate import LOW_THRESHOLD


def scored_detector(weights: Path | None) -> OnnxDetector | YoloDetector:
    """The shipped one for None; of one output: a YOLO trained on trunks and posts, as published.

    Raises ModelError for a file that is no detector.
    """
    path = weights or WEIGHTS
    session = open_model(path)
    if len(session.get_outputs()) == 1:
        return YoloDetector(session, str(path), published(LOW_THRESHOLD))
    return OnnxDetector(OnnxDetectorParams(weights=path, decoding=DecodingParams(threshold=LOW_THRESHOLD)))


def published(threshold: float) -> YoloParams:
    """The published detector's way with another threshold."""
    return replace(PUBLISHED, decoding=replace(PUBLISHED.decoding, threshold=threshold))
