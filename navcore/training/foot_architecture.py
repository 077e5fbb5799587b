"""Our own detector as `rowpilot train` makes it: feet, with boxes above them."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from torch import Tensor, nn

from navcore.perception.box_decoding import DecodingParams
from navcore.perception.detector import Detector
from navcore.training.evaluate import LOW_THRESHOLD
from navcore.training.export import export_onnx
from navcore.training.loss import LossParams, loss
from navcore.training.model import FootNet, FootNetParams
from navcore.training.pictures import BatchLabels
from navcore.training.targets import targets
from navcore.training.torch_detector import TorchDetector


@dataclass(frozen=True, slots=True, kw_only=True)
class FootArchitecture:
    """An `Architecture`."""

    params: FootNetParams = FootNetParams()
    weights: LossParams = LossParams()
    learning_rate: float = 4e-3

    def told(self) -> dict[str, Any]:
        """Kind and shape."""
        return {"kind": "feet", "params": asdict(self.params)}

    def net(self) -> nn.Module:
        """A `FootNet`."""
        return FootNet(self.params)

    def loss(self, outputs: tuple[Tensor, ...], labels: BatchLabels, height_px: int, width_px: int) -> Tensor:
        """Focal loss of the feet, L1 and overlap of the boxes."""
        logits, boxes = outputs
        return loss(logits, boxes, targets(labels, height_px, width_px, self.params.finer), self.weights)

    def detector(self, net: nn.Module) -> Detector:
        """Peaks decoded as on the robot."""
        return TorchDetector(net, DecodingParams(threshold=LOW_THRESHOLD))

    def export(self, net: nn.Module, path: Path) -> float:
        """Outputs as `OnnxDetector` reads them."""
        return export_onnx(net, path)
