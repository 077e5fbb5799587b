"""A shipped detector's file as a network to train on: batch norms are folded into convolutions there."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from torch import Tensor, nn

from navcore.errors import InputError, ModelError
from navcore.training.model import CLASSES, FootNetParams

Convolutions = dict[str, tuple[Tensor, Tensor]]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ShippedWeights:
    """Attributes:
    params: shape of the network in the file, which tells boxes per class from now on.
    convolutions: weight and bias of each, by its name in a `FootNet`; norms are folded in.
    """

    params: FootNetParams
    convolutions: Convolutions


def read_shipped(path: Path) -> ShippedWeights:
    """Raises ModelError for a file that is none of ours, InputError without the package that reads ONNX files."""
    try:
        import onnx
    except ImportError as error:
        raise InputError("Weights are read from ONNX files by the package `onnx`; install rowpilot[dev].") from error
    try:
        told = _convolutions(onnx.load(path).graph, onnx.numpy_helper.to_array)
        return ShippedWeights(params=_shape(told), convolutions=_strongest_first(_per_class(told)))
    except (OSError, onnx.onnx_cpp2py_export.checker.ValidationError) as error:
        raise ModelError(f"{path} cannot be read: {error}.") from error
    except Exception as error:  # a broken file raises protobuf's errors, another network's KeyError and the like
        raise ModelError(
            f"{path} is no detector of feet in single precision; name a feet.onnx or a best.pt of `rowpilot train`."
        ) from error


def _convolutions(graph: Any, to_array: Any) -> Convolutions:
    values = {tensor.name: torch.from_numpy(np.array(to_array(tensor), np.float32)) for tensor in graph.initializer}
    for same in (node for node in graph.node if node.op_type == "Identity" and node.input[0] in values):
        values[same.output[0]] = values[same.input[0]]
    nodes = [node for node in graph.node if node.op_type == "Conv"]
    return {_name(node.name): (values[node.input[1]], values[node.input[2]]) for node in nodes}


def _name(node: str) -> str:
    """The module's name: `/net/stride_8/stride_8.1/change/change.0/Conv` is of `stride_8.1.change.0`."""
    parts = node.strip("/").split("/")[1:-1]
    own = [part for part, below in zip(parts, [*parts[1:], ""], strict=True) if not below.startswith(part + ".")]
    return ".".join(own)


def _shape(told: Convolutions) -> FootNetParams:
    """Channels and depths as the file's convolutions have them."""
    wide = {name: len(bias) for name, (_, bias) in told.items()}
    stages = ("stride_4.1", "stride_8", "stride_16", "stride_32")
    a, b, c, d, e = (wide[name] for name in ("stride_4.0.0", *(f"{stage}.0.0" for stage in stages)))
    at_4, at_8, at_16, at_32 = (sum(f"{stage}.{i}.change.0" in wide for i in range(1, 99)) for stage in stages)
    return FootNetParams(
        channels=(a, b, c, d, e), depths=(at_4, at_8, at_16, at_32), head=told["logits"][0].shape[1],
        separable="head.3" in told, finer=round((wide["logits"] / CLASSES) ** 0.5),
    )  # fmt: skip


def _per_class(told: Convolutions) -> Convolutions:
    """Boxes that both classes share are each class's own from now on."""
    weight, bias = told["boxes"]
    times = CLASSES * 4 // len(bias)
    return {**told, "boxes": (weight.repeat(times, 1, 1, 1), bias.repeat(times))}


def finer_feet(told: Convolutions, finer: int) -> Convolutions:
    """The same with feet told `finer` times as finely as boxes: a cell's parts begin with what the cell told."""
    weight, bias = told["logits"]
    parts = finer**2 * CLASSES // len(bias)
    if parts < 2:
        return told
    return {**told, "logits": (weight.repeat_interleave(parts, dim=0), bias.repeat_interleave(parts))}


def _strongest_first(told: Convolutions) -> Convolutions:
    """The head's channels by how much hangs on them, so that a narrower head takes the right ones over."""
    last = "head.3" if "head.3" in told else "head.0"
    outputs = {name: told[name] for name in ("logits", "boxes")}
    effect = sum(weight.flatten(2).abs().sum(dim=(0, 2)) for weight, _ in outputs.values())
    order = (told[last][0].flatten(1).norm(dim=1) * effect).argsort(descending=True)
    mixed = {name: (weight[:, order], bias) for name, (weight, bias) in outputs.items()}
    return {**told, last: (told[last][0][order], told[last][1][order]), **mixed}


def fold_back(net: nn.Module, told: Convolutions, images: Tensor) -> None:
    """Start `net` from the convolutions; it tells what the file does, for `images` (B, 3, H, W) in training, too.

    A layer with fewer channels takes the first ones, one with more keeps its others as they are, without effect on
    the next layer; a layer of another kind stays as it is.
    """
    modules = dict(net.named_modules())
    fitting = {name: pair for name, pair in told.items() if _alike(modules.get(name), pair[0])}
    for name, (weight, bias) in fitting.items():
        _take_over(modules[name], weight, bias)
    norms = {name: modules.get(_next(name)) for name in fitting}
    hooks = [
        norm.register_forward_pre_hook(_settling(fitting[name][1]))
        for name, norm in norms.items() if isinstance(norm, nn.BatchNorm2d)
    ]  # fmt: skip
    with torch.no_grad():
        net.eval()(images)
    for hook in hooks:
        hook.remove()


def _next(name: str) -> str:
    """The module after that one in the same sequence."""
    before, _, number = name.rpartition(".")
    return f"{before}.{int(number) + 1}" if number.isdecimal() else ""


def _alike(module: nn.Module | None, weight: Tensor) -> bool:
    """Whether it is such a convolution, of each channel by itself or of all."""
    if not isinstance(module, nn.Conv2d) or module.weight.shape[2:] != weight.shape[2:]:
        return False
    return bool((module.groups > 1) == (weight.shape[1] == 1))


@torch.no_grad()
def _take_over(module: nn.Module, weight: Tensor, bias: Tensor) -> None:
    assert isinstance(module, nn.Conv2d)
    out, of = (min(own, told) for own, told in zip(module.weight.shape[:2], weight.shape[:2], strict=True))
    module.weight[:out] = 0.0
    module.weight[:out, :of] = weight[:out, :of]
    if module.bias is not None:
        module.bias[:out] = bias[:out]


def _settling(bias: Tensor) -> Any:
    """Makes a norm add the bias and nothing else to what it is given, and learn that as the usual."""

    @torch.no_grad()
    def settle(norm: nn.BatchNorm2d, inputs: tuple[Tensor, ...]) -> None:
        variance, mean = torch.var_mean(inputs[0], dim=(0, 2, 3), correction=0)
        out = min(len(bias), len(mean))
        norm.running_mean.copy_(mean)  # type: ignore[union-attr]
        norm.running_var.copy_(variance)  # type: ignore[union-attr]
        norm.weight[:out] = (variance + norm.eps).sqrt()[:out]
        norm.bias[:out] = bias[:out] + mean[:out]

    return settle
