"""The ground's net as the robot runs it, checked against torch."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import onnxruntime as ort
import torch
from torch import Tensor, nn

from navcore.perception.published_fusion.ground_segmenter import SIDE_PX
from navcore.training.onnx_file import write_onnx


class DeployedGround(nn.Module):
    """(1, 3, S, S) -> probabilities (1, 1, S, S)."""

    def __init__(self, net: nn.Module) -> None:
        super().__init__()
        self.net = net

    def forward(self, image: Tensor) -> Tensor:
        probability: Tensor = self.net(image).sigmoid()
        return probability


def export_ground(net: nn.Module, path: Path, *, max_difference: float = 1e-3) -> float:
    """Write the net to `path`; the largest difference of its probabilities from torch's on random pictures.

    Raises ModelError, and leaves no file, if that is more than `max_difference`.
    """
    deployed = DeployedGround(net).eval()
    return write_onnx(
        deployed, path, image="image", outputs=["ground"], difference=lambda: _largest_difference(deployed, path),
        max_difference=max_difference, size=(SIDE_PX, SIDE_PX),
    )  # fmt: skip


def _largest_difference(deployed: nn.Module, path: Path, *, pictures: int = 3, seed: int = 1) -> float:
    session = ort.InferenceSession(str(path), providers=["CPUExecutionProvider"])
    rng, worst = np.random.default_rng(seed), 0.0
    for _ in range(pictures):
        blob = rng.random((1, 3, SIDE_PX, SIDE_PX), dtype=np.float32)
        with torch.no_grad():
            wanted = deployed(torch.from_numpy(blob)).numpy()
        worst = max(worst, float(np.abs(session.run(None, {"image": blob})[0] - wanted).max()))
    return worst
