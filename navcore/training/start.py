"""What a training run begins with instead of random weights: a detector that is shipped, or one that was trained."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from torch import Tensor, nn

from navcore.errors import ModelError
from navcore.training.architecture import Architecture
from navcore.training.architecture_choice import load_trained
from navcore.training.foot_architecture import FootArchitecture
from navcore.training.shipped_weights import finer_feet, fold_back, read_shipped


@dataclass(frozen=True, slots=True, kw_only=True)
class Start:
    """Attributes:
    architecture: of the network to train.
    begin: gives a network of it the weights; asks for pictures (B, 3, H, W), BGR, 0 to 1, as they will be trained on.
    """

    architecture: Architecture
    begin: Callable[[nn.Module, Tensor], None]


def start_from(weights: Path, wanted: Architecture | None) -> Start:
    """Of an ONNX file of ours or a `best.pt`; None: to train the architecture that it has.

    Raises ModelError for a file that is neither or does not fit.
    """
    return _shipped(weights, wanted) if weights.suffix == ".onnx" else _trained(weights, wanted)


def _shipped(weights: Path, wanted: Architecture | None) -> Start:
    """Layers of another shape begin with what both have; a robot's file knows no others than ours."""
    shipped = read_shipped(weights)
    architecture = wanted or FootArchitecture(params=shipped.params)
    if not isinstance(architecture, FootArchitecture):
        raise ModelError(f"{weights} holds a network of our own; leave --net out, or begin without --from.")
    told = finer_feet(shipped.convolutions, architecture.params.finer)
    return Start(architecture=architecture, begin=lambda net, images: fold_back(net, told, images))


def _trained(weights: Path, wanted: Architecture | None) -> Start:
    architecture, trained = load_trained(weights)
    if wanted is not None and wanted.told() != architecture.told():
        raise ModelError(f"{weights} is of another network than --net tells; leave --net out.")

    def begin(net: nn.Module, _: Tensor) -> None:
        net.load_state_dict(trained.state_dict())

    return Start(architecture=architecture, begin=begin)
