"""From the published detector's torch weights to an ONNX file in the layout of YOLOv8's own export."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from navcore.training.model import INPUT_HEIGHT_PX, INPUT_WIDTH_PX
from navcore.training.onnx_file import largest_difference, write_onnx
from navcore.training.yolo_net import cell_centres, corners, flattened

Singles = NDArray[np.float32]


class DeployedYolo(nn.Module):
    """(1, 3, H, W) RGB, 0 to 1 -> (1, 4 + 2, N): middle, width and height in pixels, then a score per class."""

    def __init__(self, net: nn.Module) -> None:
        super().__init__()
        self.net = copy.deepcopy(net)
        first = next(p for p in self.net.parameters() if p.dim() == 4)
        first.data = first.data.flip(1)

    def forward(self, image: Tensor) -> Tensor:
        maps = self.net(image)
        sides, classes = flattened(maps)
        boxes = corners(sides, *cell_centres(maps))
        low, high = boxes[..., :2], boxes[..., 2:]
        return torch.cat(((low + high) / 2, high - low, classes.sigmoid()), dim=2).transpose(1, 2)


def export_yolo(net: nn.Module, path: Path, *, max_difference: float = 1e-2) -> float:
    """Write the network to `path`; the largest difference of its outputs from torch's on random pictures, of px and
    scores.

    Raises ModelError, and leaves no file, if that is more than `max_difference`.
    """
    deployed = DeployedYolo(net).eval()
    return write_onnx(
        deployed, path, image="images", outputs=["output0"], difference=lambda: largest_difference(deployed, path),
        max_difference=max_difference,
    )  # fmt: skip


@dataclass(frozen=True, slots=True)
class _Input:
    name: str
    shape: tuple[int, int, int, int]


class TorchSession:
    """Weights in torch, asked as ONNX Runtime's session is, for validation during training."""

    def __init__(self, net: nn.Module) -> None:
        self._net = DeployedYolo(net).eval()
        self._device = next(net.parameters()).device

    def get_inputs(self) -> list[_Input]:
        """The only input."""
        return [_Input("images", (1, 3, INPUT_HEIGHT_PX, INPUT_WIDTH_PX))]

    @torch.no_grad()
    def run(self, _: None, inputs: Mapping[str, Singles]) -> list[Singles]:
        """The only output."""
        output: Tensor = self._net(torch.from_numpy(inputs["images"]).to(self._device))
        return [output.cpu().numpy()]
