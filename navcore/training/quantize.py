"""A detector's ONNX file with 8-bit weights and activations, for processors that are quicker so."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.perception.detector import Image
from navcore.training.samples import Sample
from navcore.training.scored_detector import scored_detector

# More pictures hardly change the ranges that are found.
PICTURES = 64


def quantize(source: Path, target: Path, samples: Sequence[Sample]) -> None:
    """Write `target`: `source` with its convolutions in 8 bits, their ranges taken from the samples' pictures.

    The last convolution before each output stays as it is: a box is told to the pixel. Raises InputError without
    pictures or without the package that writes ONNX files, ModelError for a source that is no detector.
    """
    onnx, quantization = _packages()
    if not samples:
        raise InputError("Eight bits need pictures that the detector's ranges can be taken from.")
    detector = scored_detector(source)
    with tempfile.TemporaryDirectory(prefix="rowpilot-int8-") as folder:
        plain = Path(folder) / "plain.onnx"
        quantization.quant_pre_process(str(source), str(plain), skip_symbolic_shape=True)
        quantization.quantize_static(
            plain, target, _Pictures(detector, _spread(samples)), per_channel=True, op_types_to_quantize=["Conv"],
            nodes_to_exclude=last_convolutions(onnx.load(plain).graph),
        )  # fmt: skip


def last_convolutions(graph: Any) -> list[str]:
    """Names of the convolutions from which no other one leads to an output."""
    made_by = {name: node for node in graph.node for name in node.output}
    found, open_ends, known = [], [output.name for output in graph.output], set()
    while open_ends:
        node = made_by.get(open_ends.pop())
        if node is None or node.name in known:
            continue
        known.add(node.name)
        if node.op_type == "Conv":
            found.append(str(node.name))
        else:
            open_ends += node.input
    return found


def _packages() -> tuple[Any, Any]:
    """Both are needed for this alone, so that no robot has to carry them."""
    try:
        import onnx
        from onnxruntime import quantization
    except ImportError as error:
        raise InputError("Eight bits need the package onnx: pip install onnx.") from error
    return onnx, quantization


def _spread(samples: Sequence[Sample]) -> Iterator[Image]:
    """Pictures from all over the set, read one by one."""
    every = max(1, len(samples) // PICTURES)
    return (sample.image() for sample in islice(samples, 0, None, every))


class _Pictures:
    """What the quantizer asks for, one picture after the other."""

    def __init__(self, detector: Any, pictures: Iterator[Image]) -> None:
        self._detector, self._pictures = detector, pictures

    def get_next(self) -> dict[str, NDArray[np.float32]] | None:
        """The next input, None after the last."""
        picture = next(self._pictures, None)
        return None if picture is None else self._detector.inputs(picture)
