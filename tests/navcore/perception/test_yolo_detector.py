"""Other people's models: both layouts give the same boxes in pixels of the picture; what does not fit is said."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import onnx
import pytest
from onnx import TensorProto, helper, numpy_helper

from navcore.config import config_from_tree
from navcore.errors import ModelError
from navcore.messages import ObjectKind
from navcore.perception.detector import DetectorParams
from navcore.perception.detector_choice import new_detector
from navcore.perception.onnx_detector import OnnxDetector

PICTURE = np.full((360, 640, 3), 100, np.uint8)
# Middle x, y, width, height in the model's 640 x 640 pixels: the picture lies 140 px from its upper edge.
TRUNK, POST = (100.0, 340.0, 20.0, 80.0), (400.0, 300.0, 16.0, 200.0)
CLASSES = {ObjectKind.TRUNK: (2,), ObjectKind.POST: (0, 1)}


def model(path: Path, output: np.ndarray, side: int | str = 640) -> str:
    """An ONNX file that says `output` of every picture."""
    values = numpy_helper.from_array(output.astype(np.float32), "values")
    axes = numpy_helper.from_array(np.array([0, 1, 2, 3], np.int64), "axes")
    zero = numpy_helper.from_array(np.zeros(1, np.float32), "zero")
    nodes = [
        helper.make_node("ReduceMean", ["images", "axes"], ["mean"], keepdims=0),
        helper.make_node("Mul", ["mean", "zero"], ["nothing"]),
        helper.make_node("Add", ["values", "nothing"], ["output0"]),
    ]
    graph = helper.make_graph(
        nodes, "yolo", [helper.make_tensor_value_info("images", TensorProto.FLOAT, [1, 3, side, side])],
        [helper.make_tensor_value_info("output0", TensorProto.FLOAT, output.shape)], [values, axes, zero],
    )  # fmt: skip
    onnx.save(helper.make_model(graph, opset_imports=[helper.make_opsetid("", 18)], ir_version=8), str(path))
    return str(path)


def version_8(*rows: tuple[float, ...]) -> np.ndarray:
    """(1, 4 + 3, N): boxes and scores of three classes; filled up with nothing."""
    full = np.zeros((40, 7))
    full[: len(rows)] = rows
    return full.T[None]


def version_5(*rows: tuple[float, ...]) -> np.ndarray:
    """(1, N, 5 + 3): the same with half the score as objectness and doubled scores."""
    full = np.zeros((40, 8))
    for i, row in enumerate(rows):
        full[i] = (*row[:4], 0.5, *(2 * s for s in row[4:]))
    return full[None]


ROWS = (
    (*TRUNK, 0.0, 0.0, 0.45),
    (*POST, 0.0, 0.4, 0.0),
    (*POST, 0.3, 0.35, 0.0),
    (500.0, 300.0, 9.0, 9.0, 0.1, 0.1, 0.2),
)


@pytest.mark.parametrize("output", [version_8(*ROWS), version_5(*ROWS)], ids=["version 8", "version 5"])
@pytest.mark.parametrize("side", [640, "size"])
def test_both_layouts_give_the_same_boxes_in_pixels_of_the_picture(
    tmp_path: Path, output: np.ndarray, side: int | str
) -> None:
    weights = model(tmp_path / "yolo.onnx", output, side)
    trunk, post = new_detector(DetectorParams(weights=weights, classes=CLASSES)).detect(PICTURE)
    assert (trunk.kind, post.kind) == (ObjectKind.TRUNK, ObjectKind.POST)
    assert (trunk.x1, trunk.y1, trunk.x2, trunk.y2) == pytest.approx((90.0, 160.0, 110.0, 240.0))
    assert (post.x1, post.y1, post.x2, post.y2) == pytest.approx((392.0, 60.0, 408.0, 260.0))
    assert (trunk.confidence, post.confidence) == pytest.approx((0.45, 0.4), abs=1e-6)


def test_a_picture_of_another_size_gives_boxes_in_its_own_pixels(tmp_path: Path) -> None:
    weights = model(tmp_path / "yolo.onnx", version_8(ROWS[0]))
    [trunk] = new_detector(DetectorParams(weights=weights, classes=CLASSES)).detect(
        np.zeros((720, 1280, 3), np.uint8)
    )
    assert (trunk.x1, trunk.y2) == pytest.approx((180.0, 480.0))


def test_a_model_whose_classes_nobody_told_is_refused_with_what_to_write(tmp_path: Path) -> None:
    weights = model(tmp_path / "yolo.onnx", version_8(*ROWS))
    with pytest.raises(ModelError, match=r"which of the 3 classes .*\[detector\] classes"):
        new_detector(DetectorParams(weights=weights))


def test_a_class_that_the_model_does_not_have_is_refused(tmp_path: Path) -> None:
    weights = model(tmp_path / "yolo.onnx", version_8(*ROWS))
    with pytest.raises(ModelError, match="3 classes"):
        new_detector(DetectorParams(weights=weights, classes={ObjectKind.TRUNK: (3,)}))


def test_a_model_that_is_no_detector_is_refused(tmp_path: Path) -> None:
    weights = model(tmp_path / "classifier.onnx", np.zeros((1, 1000)))
    with pytest.raises(ModelError, match="no YOLO detector"):
        new_detector(DetectorParams(weights=weights, classes=CLASSES))


def test_nonsense_from_the_model_becomes_no_box(tmp_path: Path) -> None:
    rows = ((np.nan, 340.0, 20.0, 80.0, 0.0, 0.0, 0.9), (100.0, 340.0, np.inf, 80.0, 0.0, 0.0, 0.9))
    weights = model(tmp_path / "yolo.onnx", version_8(*rows))
    assert new_detector(DetectorParams(weights=weights, classes=CLASSES)).detect(PICTURE) == ()


def test_the_settings_name_the_detector_and_without_them_it_is_the_shipped_one(tmp_path: Path) -> None:
    weights = model(tmp_path / "yolo.onnx", version_8(*ROWS))
    tree = {"detector": {"weights": weights, "classes": {"trunk": [2], "post": [0, 1]}, "threshold": 0.42}}
    assert len(new_detector(config_from_tree(tree).detector).detect(PICTURE)) == 1
    assert isinstance(new_detector(config_from_tree({}).detector), OnnxDetector)
