"""An ONNX file of a network, which stays only if it tells the same as torch does."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from pathlib import Path

import numpy as np
import onnxruntime as ort
import torch
from torch import nn

from navcore.errors import ModelError
from navcore.training.model import INPUT_HEIGHT_PX, INPUT_WIDTH_PX


def write_onnx(
    deployed: nn.Module, path: Path, *, image: str, outputs: list[str], difference: Callable[[], float],
    max_difference: float, size: tuple[int, int] = (INPUT_HEIGHT_PX, INPUT_WIDTH_PX),
) -> float:  # fmt: skip
    """Write a network of one input, called `image`, to `path`; the `difference` that is measured of the file then.

    Pictures are of `size`, height and width in pixels.

    Raises ModelError, and leaves no file, if that is more than `max_difference`.
    """
    blob = torch.zeros(1, 3, *size)
    with warnings.catch_warnings():
        # The exporter that needs no further package tells at length that there is a newer one.
        warnings.simplefilter("ignore")
        torch.onnx.export(
            deployed, (blob,), str(path), dynamo=False, opset_version=17, input_names=[image], output_names=outputs
        )
    measured = difference()
    if measured > max_difference:
        path.unlink()
        raise ModelError(f"The exported network differs from torch by {measured:.2g}; do not use it.")
    return measured


def largest_difference(
    deployed: nn.Module, path: Path, size: tuple[int, int] = (INPUT_HEIGHT_PX, INPUT_WIDTH_PX), *, pictures: int = 3,
    seed: int = 1,
) -> float:  # fmt: skip
    """Of the file's one output from torch's, on random pictures of `size`."""
    session = ort.InferenceSession(str(path), providers=["CPUExecutionProvider"])
    name, rng, worst = session.get_inputs()[0].name, np.random.default_rng(seed), 0.0
    for _ in range(pictures):
        blob = rng.random((1, 3, *size), dtype=np.float32)
        with torch.no_grad():
            wanted = deployed(torch.from_numpy(blob)).numpy()
        worst = max(worst, float(np.abs(session.run(None, {name: blob})[0] - wanted).max()))
    return worst
