"""The ground's net as the robot runs it, checked against torch."""

from __future__ import annotations

from pathlib import Path

from torch import Tensor, nn

from navcore.perception.published_fusion.ground_segmenter import SIDE_PX
from navcore.training.onnx_file import largest_difference, write_onnx


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
    deployed, size = DeployedGround(net).eval(), (SIDE_PX, SIDE_PX)
    return write_onnx(
        deployed, path, image="image", outputs=["ground"], max_difference=max_difference,
        difference=lambda: largest_difference(deployed, path, size), size=size,
    )  # fmt: skip
