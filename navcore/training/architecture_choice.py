"""The architectures that can be trained, by name, and the one that a file of weights was made with."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import torch
from torch import nn

from navcore.errors import InputError, ModelError
from navcore.training.architecture import Architecture
from navcore.training.attention import ATTENTION
from navcore.training.foot_architecture import FootArchitecture
from navcore.training.model import NETS, FootNetParams
from navcore.training.yolo_architecture import YoloArchitecture
from navcore.training.yolo_net import YoloNetParams

ARCHITECTURES: dict[str, Architecture] = {
    **{name: FootArchitecture(params=params) for name, params in NETS.items()},
    **{name: YoloArchitecture(params=YoloNetParams(attention=name)) for name in ATTENTION},
}


def named_architecture(name: str) -> Architecture:
    """Raises InputError for a name that is none."""
    if name not in ARCHITECTURES:
        raise InputError(f"There is no network {name!r}; choose one of {', '.join(ARCHITECTURES)}.")
    return ARCHITECTURES[name]


def told_architecture(told: dict[str, Any]) -> Architecture:
    """The inverse of `Architecture.told`. Raises KeyError, TypeError or ValueError for anything else."""
    params: dict[str, Any] = {name: tuple(v) if isinstance(v, list) else v for name, v in told["params"].items()}
    if told["kind"] == "feet":
        return FootArchitecture(params=FootNetParams(**params))
    if told["kind"] == "yolo":
        return YoloArchitecture(params=YoloNetParams(**params))
    raise ValueError(told["kind"])


def load_trained(path: Path) -> tuple[Architecture, nn.Module]:
    """Architecture and network of a `best.pt`, ready to detect. Raises ModelError for anything else."""
    try:
        state = torch.load(path, weights_only=True, map_location="cpu")
        architecture = told_architecture(state["architecture"])
        net = architecture.net()
        net.load_state_dict(state["net"])
    except Exception as error:  # torch raises pickle, zip and runtime errors of all kinds for a broken file
        raise ModelError(f"{path} holds no weights of this detector.") from error
    return architecture, net.eval()
