"""From torch weights to the ONNX file that the robot runs, checked against each other."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import onnxruntime as ort
import torch
from torch import Tensor, nn

from navcore.errors import ModelError
from navcore.training.model import INPUT_HEIGHT_PX, INPUT_WIDTH_PX, peaks


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
    deployed = Deployed(net).eval()
    blob = torch.zeros(1, 3, INPUT_HEIGHT_PX, INPUT_WIDTH_PX)
    with warnings.catch_warnings():
        # The exporter that needs no further package tells at length that there is a newer one.
        warnings.simplefilter("ignore")
        torch.onnx.export(
            deployed, (blob,), str(path), dynamo=False, opset_version=17, input_names=["image"],
            output_names=["peaks", "boxes"],
        )  # fmt: skip
    difference = largest_difference(net, path)
    if difference > max_difference:
        path.unlink()
        raise ModelError(f"The exported detector differs from torch by {difference:.2g}; do not use it.")
    return difference


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
