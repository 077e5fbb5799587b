"""From torch weights to the ONNX file that the robot runs, checked against each other."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import onnxruntime as ort
import torch
from torch import Tensor, nn

from navcore.training.model import INPUT_HEIGHT_PX, INPUT_WIDTH_PX, peaks
from navcore.training.onnx_file import write_onnx


class Deployed(nn.Module):
    """The network as it is shipped: probabilities at peaks instead of logits."""

    def __init__(self, net: nn.Module) -> None:
        super().__init__()
        self.net = net

    def forward(self, image: Tensor) -> tuple[Tensor, Tensor]:
        logits, boxes = self.net(image)
        return peaks(logits), boxes


def export_onnx(net: nn.Module, path: Path, *, max_difference: float = 1e-3) -> float:
    """Write the network to `path`; the largest absolute difference of its outputs from torch on random pictures.

    Raises ModelError, and leaves no file, if that is more than `max_difference`.
    """
    return write_onnx(
        Deployed(net).eval(), path, image="image", outputs=["peaks", "boxes"],
        difference=lambda: largest_difference(net, path), max_difference=max_difference,
    )  # fmt: skip


def largest_difference(net: nn.Module, path: Path, *, pictures: int = 3, seed: int = 1) -> float:
    """Largest absolute difference of the file's probabilities and box values from torch's.

    Peaks are compared before suppression of neighbours: a tie that rounds the other way is no difference.
    """
    session = ort.InferenceSession(str(path), providers=["CPUExecutionProvider"])
    rng, worst = np.random.default_rng(seed), 0.0
    for _ in range(pictures):
        blob = rng.random((1, 3, INPUT_HEIGHT_PX, INPUT_WIDTH_PX), dtype=np.float32)
        found, boxes = session.run(None, {"image": blob})
        with torch.no_grad():
            logits, wanted = net(torch.from_numpy(blob))
        probability = logits.sigmoid().numpy()
        worst = max(worst, float(np.abs(boxes - wanted.numpy()).max()))
        worst = max(worst, float(np.abs(found - probability)[found > 0].max(initial=0.0)))
    return worst
