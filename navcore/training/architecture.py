"""What `rowpilot train` asks of a detector's network: everything else about training is the same for all."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

from torch import Tensor, nn

from navcore.perception.detector import Detector
from navcore.training.pictures import BatchLabels


class Architecture(Protocol):
    """A network with its loss and its file format."""

    @property
    def learning_rate(self) -> float:
        """The highest of a run, of AdamW."""
        ...

    def told(self) -> dict[str, Any]:
        """What `architecture_choice.told_architecture` makes the same architecture of."""
        ...

    def net(self) -> nn.Module:
        """A network with fresh weights, for pictures (B, 3, H, W), BGR, 0 to 1."""
        ...

    def loss(self, outputs: tuple[Tensor, ...], labels: BatchLabels, height_px: int, width_px: int) -> Tensor:
        """Of the network's outputs, single precision, for pictures of that size."""
        ...

    def detector(self, net: nn.Module) -> Detector:
        """The network as a detector for validation, of all above `evaluate.LOW_THRESHOLD`."""
        ...

    def export(self, net: nn.Module, path: Path) -> float:
        """Write an ONNX file; the largest difference of its outputs from torch's. Raises ModelError if it is much."""
        ...
