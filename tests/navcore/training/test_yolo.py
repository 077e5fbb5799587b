"""The published detectors: shapes, a loss that falls, and a file that says what torch says."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from navcore.errors import InputError
from navcore.perception.onnx_detector import open_model
from navcore.perception.yolo_detector import PUBLISHED, YoloDetector
from navcore.training.architecture_choice import ARCHITECTURES, load_trained, named_architecture, told_architecture
from navcore.training.attention import ATTENTION
from navcore.training.augment import AugmentParams
from navcore.training.box_overlap import complete_iou
from navcore.training.evaluate import evaluate
from navcore.training.pictures import Pictures, stack_labels
from navcore.training.samples import Labels, read_samples
from navcore.training.scored_detector import scored_detector
from navcore.training.trainer import Trainer, TrainerParams
from navcore.training.yolo_architecture import YoloArchitecture
from navcore.training.yolo_assignment import AssignmentParams, Cells, assign, seen_labels
from navcore.training.yolo_net import YoloNet, YoloNetParams
from tests.navcore.training.farm_pictures import draw_set

CPU = torch.device("cpu")
TINY = YoloNetParams(channels=(8, 8, 16, 16, 16), depths=(1, 1, 1, 1))


@pytest.mark.parametrize("name", ATTENTION)
def test_every_attention_keeps_the_shape_and_passes_a_gradient(name: str) -> None:
    x = torch.randn(2, 64, 6, 10, requires_grad=True)
    y = ATTENTION[name](64)(x)
    y.square().sum().backward()
    assert y.shape == x.shape
    assert x.grad is not None
    assert x.grad.abs().min() >= 0.0
    assert x.grad.abs().sum() > 0.0


@pytest.mark.parametrize("name", ATTENTION)
def test_every_variant_has_maps_at_three_strides_and_is_built_again_from_what_it_tells(name: str) -> None:
    architecture = told_architecture(named_architecture(name).told())
    maps = architecture.net()(torch.zeros(1, 3, 64, 96))
    assert [tuple(one.shape) for one in maps] == [(1, 66, 8, 12), (1, 66, 4, 6), (1, 66, 2, 3)]
    assert architecture == ARCHITECTURES[name]


def test_plain_yolo_has_as_many_weights_as_yolov8_nano_is_told_to_have() -> None:
    assert sum(p.numel() for p in YoloNet().parameters()) == pytest.approx(3.0e6, rel=0.02)


def test_a_name_that_is_no_network_is_refused_with_those_that_are() -> None:
    with pytest.raises(InputError, match="small, large, yolov8n, rescbam, eca, gam, sa"):
        named_architecture("yolov99")


@pytest.mark.parametrize("name", ATTENTION)
def test_the_loss_falls_on_a_few_pictures(name: str, tmp_path: Path) -> None:
    draw_set(tmp_path / "set", 2, 1)
    images, labels = Pictures(read_samples(tmp_path / "set"), 384, 640, CPU).batch([0, 1])
    torch.manual_seed(1)
    architecture = YoloArchitecture(params=replace(TINY, channels=(8, 8, 16, 32, 32), attention=name))
    net = architecture.net()
    optimizer = torch.optim.AdamW(net.parameters(), lr=3e-3)
    losses = []
    for _ in range(6):
        loss = architecture.loss(net(images.float() / 255), labels, 384, 640)
        optimizer.zero_grad()
        loss.backward()  # type: ignore[no-untyped-call]
        optimizer.step()
        losses.append(loss.item())
    assert np.isfinite(losses).all()
    assert losses[-1] < 0.9 * losses[0]


@pytest.mark.parametrize("name", ATTENTION)
def test_the_exported_file_says_what_torch_says(name: str, tmp_path: Path) -> None:
    torch.manual_seed(2)
    architecture = YoloArchitecture(params=replace(TINY, channels=(8, 8, 16, 32, 32), attention=name))
    net = architecture.net().eval()
    path = tmp_path / "yolo.onnx"
    assert architecture.export(net, path) < 1e-2
    [output] = open_model(path).get_outputs()
    assert output.shape == [1, 6, 5040]


def test_a_net_trained_on_four_pictures_finds_them_from_its_file(tmp_path: Path) -> None:
    draw_set(tmp_path / "set", 4, 3)
    samples = read_samples(tmp_path / "set")
    params = TrainerParams(
        epochs=160, batch=4, learning_rate=8e-3, average=0.9, device="cpu", validate_every=1.0,
        architecture=YoloArchitecture(params=TINY),
        augment=AugmentParams(width_px=512, height_px=384, scale=1.02, stretch=1.0, gain=1.0, gamma=1.0, noise=0.0),
    )  # fmt: skip
    architecture, net = load_trained(Trainer(tmp_path / "run", samples, samples, params).run(lambda _: None))
    architecture.export(net, tmp_path / "yolo.onnx")
    scores = evaluate(scored_detector(tmp_path / "yolo.onnx"), samples, 0.3)[0]
    assert scores.map50 > 0.9
    assert scores.feet.recall > 0.9
    image = samples[0].image()
    found = YoloDetector(open_model(tmp_path / "yolo.onnx"), "yolo", PUBLISHED).detect(image)
    trained = architecture.detector(net).detect(image)[: len(found)]
    assert len(found) >= 4
    assert [o.x1 for o in found] == pytest.approx([o.x1 for o in trained], abs=0.05)  # px


def test_complete_iou_is_one_for_the_same_box_and_below_zero_for_one_far_off() -> None:
    box = torch.tensor([10.0, 10.0, 14.0, 30.0])
    assert complete_iou(box, box) == pytest.approx(1.0, abs=1e-5)
    half = complete_iou(box, box + torch.tensor([0.0, 0.0, 4.0, 0.0]))
    assert 0.4 < half < 0.5
    assert complete_iou(box, box + 100.0) < 0.0


def cells(boxes: torch.Tensor, score: float = 0.5) -> Cells:
    """Cells of stride 8 in a row, each of which says the given box."""
    n = len(boxes)
    centres = torch.stack((8.0 * torch.arange(n) + 4.0, torch.full((n,), 4.0)), dim=1)
    return Cells(
        boxes=boxes[None], scores=torch.full((1, n, 2), score), centres=centres, strides=torch.full((n,), 8.0)
    )


def test_a_trunk_thinner_than_a_cell_is_answered_for_and_an_ignored_one_is_not_asked() -> None:
    boxes = np.array([[2.0, 0.0, 4.0, 8.0], [34.0, 0.0, 37.0, 8.0]])
    labels = stack_labels(
        [Labels(boxes=boxes, kinds=np.array([1, 0]), ignore=np.array([False, True]))], [1.0], CPU
    )  # fmt: skip
    found = assign(cells(torch.tensor([[2.0, 0.0, 4.0, 8.0]] * 6)), labels, AssignmentParams())
    assert found.owned.tolist() == [[True, False, False, False, False, False]]
    assert found.unasked.tolist() == [[False, False, False, False, True, False]]
    np.testing.assert_allclose(found.score[0, 0], (0.0, 1.0), atol=1e-4)


def test_a_cell_that_two_objects_want_answers_for_the_one_it_overlaps_most() -> None:
    boxes = np.array([[0.0, 0.0, 8.0, 8.0], [0.0, 0.0, 8.0, 30.0]])
    labels = stack_labels(
        [Labels(boxes=boxes, kinds=np.array([1, 0]), ignore=np.array([False, False]))], [1.0], CPU
    )  # fmt: skip
    found = assign(cells(torch.tensor([[0.0, 0.0, 8.0, 28.0]])), labels, AssignmentParams())
    assert found.boxes[0, 0].tolist() == [0.0, 0.0, 8.0, 30.0]
    assert found.score[0, 0, 0] > 0.5


def test_what_a_crop_shows_without_its_foot_is_not_asked_for() -> None:
    boxes = np.array([[10.0, 10.0, 20.0, 50.0], [30.0, 10.0, 40.0, 80.0], [200.0, 10.0, 210.0, 40.0]])
    labels = stack_labels(
        [Labels(boxes=boxes, kinds=np.array([0, 0, 0]), ignore=np.array([False] * 3))], [1.0], CPU
    )  # fmt: skip
    seen = seen_labels(labels, 64, 96)
    assert seen.asked.tolist() == [[True, False, False]]
    assert seen.ignored[0].tolist()[1:] == [True, True]
    assert seen.boxes[0, 1].tolist() == [30.0, 10.0, 40.0, 64.0]
