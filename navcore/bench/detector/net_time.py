"""How long detectors take for a picture, measured turn by turn so that a busy moment meets them all."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import torch

from navcore.perception.onnx_detector import open_model
from navcore.training.model import INPUT_HEIGHT_PX, INPUT_WIDTH_PX
from navcore.training.yolo_export import export_yolo
from navcore.training.yolo_net import YoloNet


def yolo_sized(folder: Path) -> Path:
    """A file of a network as large as YOLOv8 nano with weights that were never trained: it takes as long."""
    path = folder / "untrained-yolov8n.onnx"
    torch.manual_seed(1)
    export_yolo(YoloNet().eval(), path)
    return path


def run_times(models: Mapping[str, Path], *, rounds: int) -> dict[str, float]:
    """Median seconds per 640 x 384 picture on one thread of ONNX Runtime, pictures' preparation aside."""
    sessions = {name: open_model(path) for name, path in models.items()}
    blob = np.random.default_rng(1).random((1, 3, INPUT_HEIGHT_PX, INPUT_WIDTH_PX), dtype=np.float32)
    taken: dict[str, list[float]] = {name: [] for name in sessions}
    for _ in range(rounds + 2):
        for name, session in sessions.items():
            taken[name].append(_seconds(session, blob))
    return {name: _median(values[2:]) for name, values in taken.items()}


def _seconds(session: Any, blob: np.ndarray) -> float:
    inputs, started = {session.get_inputs()[0].name: blob}, time.perf_counter()
    session.run(None, inputs)
    return time.perf_counter() - started


def _median(values: Sequence[float]) -> float:
    return float(np.median(values))
