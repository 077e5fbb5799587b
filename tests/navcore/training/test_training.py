"""A training run in small: it learns, it resumes, and what is shipped is what was trained."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from navcore.errors import InputError, ModelError
from navcore.perception.onnx_detector import OnnxDetector, OnnxDetectorParams
from navcore.training.architecture_choice import load_trained
from navcore.training.budget import Budget
from navcore.training.evaluate import evaluate, table
from navcore.training.export import export_onnx
from navcore.training.foot_architecture import FootArchitecture
from navcore.training.loss import LossParams, box_loss, focal_loss
from navcore.training.model import FootNet, FootNetParams
from navcore.training.pictures import Pictures, stack_labels
from navcore.training.samples import Labels, read_samples
from navcore.training.targets import targets
from navcore.training.torch_detector import TorchDetector
from navcore.training.trainer import Trainer, TrainerParams
from tests.navcore.training.farm_pictures import draw_set

CPU = torch.device("cpu")
SMALL = TrainerParams(
    epochs=2, batch=4, learning_rate=1e-2, device="cpu",
    architecture=FootArchitecture(params=FootNetParams(channels=(8, 8, 16, 16, 16), depths=(0, 1, 1, 1))),
)  # fmt: skip


@pytest.fixture
def pictures(tmp_path: Path) -> Path:
    draw_set(tmp_path / "set", 16, 1)
    return tmp_path / "set"


def test_a_few_steps_lower_the_loss_and_the_best_weights_can_be_loaded(pictures: Path, tmp_path: Path) -> None:
    lines: list[str] = []
    samples = read_samples(pictures)
    best = Trainer(tmp_path / "run", samples, samples[:2], replace(SMALL, epochs=5)).run(lines.append)
    losses = [float(line.split("loss ")[1].split()[0]) for line in lines if line.startswith("epoch")]
    assert losses[-1] < 0.8 * losses[0]
    assert isinstance(load_trained(best)[1], FootNet)


def test_a_resumed_run_goes_on_where_it_stopped(pictures: Path, tmp_path: Path) -> None:
    samples, lines = read_samples(pictures), list[str]()
    Trainer(tmp_path / "run", samples, samples[:2], SMALL).run(lines.append)
    again = Trainer(tmp_path / "run", samples, samples[:2], SMALL)
    again.resume()
    again.run(lines.append)
    assert [line[:8] for line in lines] == ["epoch 1 ", "epoch 2 "]


def test_resuming_nothing_is_refused(pictures: Path, tmp_path: Path) -> None:
    samples = read_samples(pictures)
    with pytest.raises(ModelError, match="without --resume"):
        Trainer(tmp_path / "none", samples, samples, SMALL).resume()


def test_the_exported_detector_finds_what_torch_finds(pictures: Path, tmp_path: Path) -> None:
    torch.manual_seed(3)
    net = FootNet().eval()
    path = tmp_path / "feet.onnx"
    assert export_onnx(net, path) < 1e-4
    image = np.random.default_rng(1).integers(0, 255, (384, 640, 3), dtype=np.uint8)
    decoding = TorchDetector(net)._decoding
    shipped = OnnxDetector(OnnxDetectorParams(weights=path, decoding=decoding)).detect(image)
    trained = TorchDetector(net).detect(image)
    assert len(shipped) == len(trained)
    for a, b in zip(shipped, trained, strict=True):
        assert (a.x1, a.y1, a.x2, a.y2) == pytest.approx((b.x1, b.y1, b.x2, b.y2), abs=0.01)  # px


def test_weights_that_are_none_are_refused(tmp_path: Path) -> None:
    (tmp_path / "best.pt").write_bytes(b"no weights")
    with pytest.raises(ModelError, match="no weights of this detector"):
        load_trained(tmp_path / "best.pt")


def test_a_flawless_detector_scores_one_and_the_table_names_every_season(pictures: Path) -> None:
    samples = read_samples(pictures)

    class Flawless:
        def __init__(self) -> None:
            self.left = list(samples)

        def detect(self, image: np.ndarray) -> object:
            from navcore.perception.box_decoding import detected_objects

            labels = self.left.pop(0).labels
            ones = np.ones(len(labels.boxes))
            return detected_objects(labels.boxes, ones, labels.kinds.tolist(), scale=1.0, width_px=256, height_px=192)

    scores = evaluate(Flawless(), samples, 0.5)  # type: ignore[arg-type]
    assert [s.name for s in scores] == ["all", "growing", "noon"]
    assert all(s.map50 == 1.0 and s.feet.recall == 1.0 and s.feet.precision == 1.0 for s in scores)
    assert "growing" in table(scores)


@pytest.mark.parametrize(
    "text", ["{", "[]", '{"images": [], "annotations": []}', '{"images": 1, "annotations": 2, "categories": []}']
)
def test_a_broken_set_is_refused_with_a_sentence(tmp_path: Path, text: str) -> None:
    (tmp_path / "annotations.json").write_text(text, encoding="utf-8")
    with pytest.raises(InputError, match="not a COCO set"):
        read_samples(tmp_path)


def test_a_set_may_not_name_pictures_outside_of_itself(pictures: Path) -> None:
    document = json.loads((pictures / "annotations.json").read_text())
    document["images"][0]["file_name"] = "../../secret.png"
    (pictures / "annotations.json").write_text(json.dumps(document))
    with pytest.raises(InputError, match="outside of the set"):
        read_samples(pictures)


def test_a_box_that_is_not_finite_is_refused(pictures: Path) -> None:
    document = json.loads((pictures / "annotations.json").read_text())
    document["annotations"][0]["bbox"][0] = float("nan")
    (pictures / "annotations.json").write_text(json.dumps(document))
    with pytest.raises(InputError, match="not finite"):
        read_samples(pictures)


def test_the_target_is_one_at_the_foot_and_tells_where_in_the_cell_it_is() -> None:
    labels = Labels(boxes=np.array([[98.0, 21.0, 106.0, 61.0]]), kinds=np.array([1]), ignore=np.array([False]))
    target = targets(stack_labels([labels], [1.0], CPU), 96, 160)
    assert target.heat.shape == (1, 2, 48, 80)
    assert target.heat.max() == target.heat[0, 1, 30, 51] == 1.0
    np.testing.assert_allclose(target.boxes[0, 1, :, 15, 25], (0.0, -0.25, np.log(2.0), np.log(10.0)), atol=1e-6)
    np.testing.assert_allclose(target.boxes[0, 1, :2, 14, 26], (-1.0, 0.75), atol=1e-6)
    assert int((target.weight > 0).sum()) == 18


def test_the_box_values_of_an_objects_class_and_cell_count_most() -> None:
    labels = Labels(boxes=np.array([[98.0, 21.0, 106.0, 61.0]]), kinds=np.array([1]), ignore=np.array([False]))
    weight = targets(stack_labels([labels], [1.0], CPU), 96, 160).weight[0, :, 14:16, 25]
    np.testing.assert_allclose(weight, [[0.1, 0.3], [0.3, 1.0]], atol=1e-6)


def test_nothing_is_asked_around_an_ignored_object() -> None:
    labels = Labels(boxes=np.array([[98.0, 21.0, 106.0, 61.0]]), kinds=np.array([1]), ignore=np.array([True]))
    target = targets(stack_labels([labels], [1.0], CPU), 96, 160)
    assert target.heat[0, :, 30, 51].tolist() == [-1.0, -1.0]
    assert target.weight.sum() == 0.0


def test_of_two_objects_of_a_class_each_keeps_its_own_cell_and_the_nearer_one_the_others() -> None:
    boxes = np.array([[96.0, 20.0, 108.0, 64.5], [100.0, 20.0, 112.0, 60.5]])
    labels = Labels(boxes=boxes, kinds=np.array([0, 0]), ignore=np.array([False, False]))
    target = targets(stack_labels([labels], [1.0], CPU), 96, 160).boxes[0, 0]
    assert target[:2, 16, 25].tolist() == pytest.approx([0.0, -0.375])
    assert target[:2, 15, 26].tolist() == pytest.approx([0.0, -0.375])
    assert target[:2, 15, 25].tolist() == pytest.approx([0.0, 0.625])


def test_a_vine_before_a_post_has_a_peak_and_a_box_of_its_own() -> None:
    boxes = np.array([[94.0, 20.0, 110.0, 62.0], [100.0, 40.0, 104.0, 62.0]])
    labels = Labels(boxes=boxes, kinds=np.array([1, 0]), ignore=np.array([False, False]))
    target = targets(stack_labels([labels], [1.0], CPU), 96, 160)
    assert target.heat[0, :, 31, 51].tolist() == [1.0, 1.0]
    widths = target.boxes[0, :, 2, 15, 25].exp()
    assert widths.tolist() == pytest.approx([1.0, 4.0])


def test_pictures_of_another_size_are_fitted_and_their_boxes_with_them(pictures: Path) -> None:
    samples = read_samples(pictures)
    images, labels = Pictures(samples, 384, 640, CPU).batch([3])
    assert images.shape == (1, 3, 384, 640)
    assert images[0, :, :, 512:].max() == 0
    np.testing.assert_allclose(labels.boxes[0, :4], samples[3].labels.boxes * 2.0)
    x1, _, x2, y2 = labels.boxes[0, 0].tolist()
    inside, ground = images[0, :, int(y2) - 4, int((x1 + x2) / 2)].float(), images[0, :, 380, 4].float()
    assert (inside - ground).abs().max() > 30


def test_a_run_that_may_take_so_many_minutes_ends_by_then_with_a_low_learning_rate() -> None:
    budget = Budget(steps=1000, minutes=1.0)
    budget.resume(done=100, elapsed=45.0)
    assert budget.fraction() == pytest.approx(0.75, abs=0.01)
    assert budget.course() < 0.2
    budget.resume(done=100, elapsed=61.0)
    assert budget.spent()


def test_a_device_that_is_not_there_is_refused(pictures: Path, tmp_path: Path) -> None:
    samples = read_samples(pictures)
    with pytest.raises(ModelError, match="no device 'abacus'"):
        Trainer(tmp_path, samples, samples, replace(SMALL, device="abacus"))


def test_the_box_loss_falls_as_boxes_come_to_overlap() -> None:
    wanted, weight = torch.zeros(1, 2, 4, 2, 2), torch.ones(1, 2, 2, 2)
    losses = [
        float(box_loss(torch.full((1, 2, 4, 2, 2), off), wanted, weight, LossParams())) for off in (1.0, 0.3, 0.0)
    ]
    assert losses[0] > losses[1] > losses[2] == pytest.approx(0.0, abs=1e-6)


def test_cells_that_are_not_asked_do_not_move_the_loss() -> None:
    heat = torch.zeros(1, 2, 4, 4)
    heat[0, 0, 1, 1] = 1.0
    heat[0, 1] = -1.0
    logits = torch.zeros(1, 2, 4, 4)
    louder = logits.clone()
    louder[0, 1] = 5.0
    assert focal_loss(logits, heat, LossParams()) == focal_loss(louder, heat, LossParams())


def test_what_is_told_of_a_class_at_the_others_foot_weighs_more_than_elsewhere() -> None:
    heat = torch.zeros(1, 2, 6, 6)
    heat[0, 0, 1, 1] = 1.0
    at_foot, elsewhere = torch.full((1, 2, 6, 6), -5.0), torch.full((1, 2, 6, 6), -5.0)
    at_foot[0, 0, 1, 1] = elsewhere[0, 0, 1, 1] = 5.0
    at_foot[0, 1, 1, 1] = elsewhere[0, 1, 4, 4] = 2.0
    more, less = (float(focal_loss(logits, heat, LossParams(confused=4.0))) for logits in (at_foot, elsewhere))
    alike = [float(focal_loss(logits, heat, LossParams(confused=1.0))) for logits in (at_foot, elsewhere)]
    assert more > 2.0 * less
    assert alike[0] == pytest.approx(alike[1])


def test_the_width_of_a_narrow_box_weighs_more_than_that_of_a_wide_one() -> None:
    wanted, weight = torch.zeros(1, 2, 4, 1, 2), torch.ones(1, 2, 1, 2)
    wanted[0, :, 2, 0, 1] = 1.5
    narrow, wide = wanted.clone(), wanted.clone()
    narrow[0, :, 2, 0, 0] += 0.3
    wide[0, :, 2, 0, 1] += 0.3
    losses = [float(box_loss(boxes, wanted, weight, LossParams())) for boxes in (narrow, wide)]
    assert losses[0] > 1.5 * losses[1]
