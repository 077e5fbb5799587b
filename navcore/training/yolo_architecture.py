"""The published detectors as `rowpilot train` makes them: YOLOv8 nano, alone or with a block of paper B, Table 2."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from torch import Tensor, nn

from navcore.perception.detector import Detector
from navcore.perception.yolo_detector import YoloDetector
from navcore.training.evaluate import LOW_THRESHOLD
from navcore.training.pictures import BatchLabels
from navcore.training.scored_detector import published
from navcore.training.yolo_assignment import seen_labels
from navcore.training.yolo_export import TorchSession, export_yolo
from navcore.training.yolo_loss import YoloLossParams, yolo_loss
from navcore.training.yolo_net import YoloNet, YoloNetParams


@dataclass(frozen=True, slots=True, kw_only=True)
class YoloArchitecture:
    """An `Architecture`. The learning rate is what YOLOv8 takes for two classes with AdamW: 0.002 * 5 / (4 + 2)."""

    params: YoloNetParams = YoloNetParams()
    weights: YoloLossParams = YoloLossParams()
    learning_rate: float = 1.67e-3

    def told(self) -> dict[str, Any]:
        """Kind and shape."""
        return {"kind": "yolo", "params": asdict(self.params)}

    def net(self) -> nn.Module:
        """A `YoloNet`."""
        return YoloNet(self.params)

    def loss(self, outputs: tuple[Tensor, ...], labels: BatchLabels, height_px: int, width_px: int) -> Tensor:
        """Complete IoU, distribution focal loss and cross entropy."""
        return yolo_loss(outputs, seen_labels(labels, height_px, width_px), self.weights)

    def detector(self, net: nn.Module) -> Detector:
        """Decoded as on the robot."""
        return YoloDetector(TorchSession(net), "in torch", published(LOW_THRESHOLD))

    def export(self, net: nn.Module, path: Path) -> float:
        """The layout of YOLOv8's own export, (1, 4 + 2, N)."""
        return export_yolo(net, path)
