"""The shipped detector and files that are none."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import onnx
import pytest
from onnx import TensorProto, helper

from navcore.errors import ModelError
from navcore.perception.onnx_detector import WEIGHTS, OnnxDetector, OnnxDetectorParams


def detector_of(path: Path) -> OnnxDetector:
    return OnnxDetector(OnnxDetectorParams(weights=path))


def other_model(path: Path, shape: tuple[int, ...]) -> Path:
    """A model that hands its input through."""
    inputs = [helper.make_tensor_value_info("image", TensorProto.FLOAT, shape)]
    outputs = [helper.make_tensor_value_info("same", TensorProto.FLOAT, shape)]
    graph = helper.make_graph([helper.make_node("Identity", ["image"], ["same"])], "other", inputs, outputs)
    onnx.save(helper.make_model(graph, opset_imports=[helper.make_opsetid("", 17)], ir_version=8), path)
    return path


def test_the_same_picture_gives_the_same_boxes() -> None:
    image = np.random.default_rng(1).integers(0, 255, (360, 640, 3), dtype=np.uint8)
    assert OnnxDetector().detect(image) == OnnxDetector().detect(image)


@pytest.mark.parametrize("size", [(360, 640), (720, 1280), (480, 640), (100, 90)])
def test_pictures_of_any_size_are_taken_and_boxes_lie_inside_of_them(size: tuple[int, int]) -> None:
    image = np.random.default_rng(1).integers(0, 255, (*size, 3), dtype=np.uint8)
    for o in OnnxDetector().detect(image):
        assert 0 <= o.x1 < o.x2 <= size[1]
        assert 0 <= o.y1 < o.y2 <= size[0]


def test_a_black_and_a_white_picture_hold_nothing() -> None:
    detector = OnnxDetector()
    for value in (0, 255):
        assert detector.detect(np.full((360, 640, 3), value, np.uint8)) == ()


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match=r"There is no detector at .*none\.onnx"):
        detector_of(tmp_path / "none.onnx")


def test_a_damaged_file_is_refused(tmp_path: Path) -> None:
    cut = tmp_path / "cut.onnx"
    cut.write_bytes(WEIGHTS.read_bytes()[:2000])
    with pytest.raises(ModelError, match="damaged or no ONNX model"):
        detector_of(cut)


def test_text_is_no_model(tmp_path: Path) -> None:
    text = tmp_path / "text.onnx"
    text.write_text("weights")
    with pytest.raises(ModelError, match="damaged or no ONNX model"):
        detector_of(text)


@pytest.mark.parametrize("shape", [(1, 3, 8, 8), (1, 1, 8, 8), (4,)])
def test_a_model_of_something_else_is_refused(tmp_path: Path, shape: tuple[int, ...]) -> None:
    with pytest.raises(ModelError, match="no trunk and post detector"):
        detector_of(other_model(tmp_path / "other.onnx", shape))


def test_the_weights_are_small_enough_for_the_repository() -> None:
    assert WEIGHTS.stat().st_size < 8e6  # bytes
    assert WEIGHTS.with_suffix(".md").is_file()
