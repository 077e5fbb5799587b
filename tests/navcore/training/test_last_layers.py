"""Only a network's last layers trained: on cells instead of pictures, and to the same end."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch
from typer.testing import CliRunner

from navcore.cli import app
from navcore.errors import ModelError
from navcore.training.architecture_choice import load_trained, named_architecture
from navcore.training.foot_architecture import FootArchitecture
from navcore.training.last_layers.head_training import HeadParams, _on_patches, train_head
from navcore.training.last_layers.hot_cells import HotCells, hot_cells
from navcore.training.model import FootNet, FootNetParams
from navcore.training.pictures import Pictures
from navcore.training.samples import Sample, read_samples
from navcore.training.start import Start, start_from
from tests.navcore.training.farm_pictures import draw_set

CPU = torch.device("cpu")
SHAPES = [
    FootNetParams(channels=(8, 8, 16, 16, 16), depths=(0, 1, 1, 1), head=16, separable=separable, finer=finer)
    for separable, finer in ((True, 2), (False, 1))
]


@pytest.fixture
def samples(tmp_path: Path) -> tuple[Sample, ...]:
    draw_set(tmp_path / "set", 12, 1)
    return read_samples(tmp_path / "set")


def begun(folder: Path, params: FootNetParams) -> Start:
    torch.manual_seed(4)
    architecture = FootArchitecture(params=params)
    torch.save({"net": FootNet(params).state_dict(), "architecture": architecture.told()}, folder / "begin.pt")
    return start_from(folder / "begin.pt", None)


def cells_of(net: FootNet, samples: tuple[Sample, ...]) -> HotCells:
    return hot_cells(net, Pictures(samples, 384, 640, CPU), 1, lambda _: None)


@pytest.mark.parametrize("params", SHAPES)
def test_a_cell_by_itself_is_told_as_in_its_picture(samples: tuple[Sample, ...], params: FootNetParams) -> None:
    torch.manual_seed(4)
    net = FootNet(params).eval()
    cells = cells_of(net, samples[:1])
    images = Pictures(samples, 384, 640, CPU).batch([0])[0].float() / 255.0
    with torch.no_grad(), _on_patches(net):
        _, alone = net.told(cells.under.float())
    with torch.no_grad():
        _, whole = net(torch.cat((images, images.flip(3))))
    away = torch.cdist(alone.flatten(1), whole.permute(0, 2, 3, 1).reshape(-1, 8)).amin(dim=1)
    assert len(cells) > 100
    assert away.max() < 0.02


def test_every_foot_is_among_the_cells_in_both_mirror_images(samples: tuple[Sample, ...]) -> None:
    cells = cells_of(FootNet(SHAPES[1]), samples)
    inside = sum(int((~s.labels.ignore).sum()) for s in samples)
    assert int((cells.heat >= 0.999).sum()) == 2 * inside
    assert float(cells.stands_for.float().sum()) == pytest.approx(2 * 12 * 96 * 160, rel=0.1)


@pytest.mark.parametrize("params", SHAPES)
def test_the_last_layers_learn_and_those_below_stay(
    samples: tuple[Sample, ...], tmp_path: Path, params: FootNetParams
) -> None:
    lines, start = list[str](), begun(tmp_path, params)
    best = train_head(start, samples, tmp_path / "run", HeadParams(epochs=10, batch=256, rate=3e-2), lines.append)
    losses = [float(line.split("loss ")[1]) for line in lines if line.startswith("epoch")]
    assert losses[-1] < 0.8 * losses[0]
    before, after = load_trained(tmp_path / "begin.pt")[1].state_dict(), load_trained(best)[1].state_dict()
    changed = {name.split(".")[0] for name in before if not np.array_equal(before[name], after[name])}
    assert changed == {"head", "logits", "boxes"}


def test_with_boxes_alone_feet_are_told_as_before_and_boxes_otherwise(
    samples: tuple[Sample, ...], tmp_path: Path
) -> None:
    began, wider = begun(tmp_path, SHAPES[1]), FootArchitecture(params=replace(SHAPES[1], head=32))
    before = began.architecture.net().eval()
    began.begin(before, torch.zeros(1, 3, 64, 64))
    began.architecture.export(before, tmp_path / "begin.onnx")
    start, params = start_from(tmp_path / "begin.onnx", wider), HeadParams(boxes_only=True, epochs=2, batch=512)
    after = load_trained(train_head(start, samples, tmp_path / "run", params, lambda _: None))[1]
    images = Pictures(samples, 384, 640, CPU).batch([0, 3])[0].float() / 255.0
    with torch.no_grad():
        (feet, boxes), (same, others) = before(images), after(images)
    np.testing.assert_allclose(same, feet, atol=1e-3)
    assert (others - boxes).abs().max() > 0.1


def test_a_published_network_has_no_last_layers_to_train(samples: tuple[Sample, ...], tmp_path: Path) -> None:
    start = Start(architecture=named_architecture("yolov8n"), begin=lambda net, images: None)
    with pytest.raises(ModelError, match="leave --head-only out"):
        train_head(start, samples, tmp_path, HeadParams(), lambda _: None)


def test_last_layers_alone_need_weights_to_begin_with(samples: tuple[Sample, ...], tmp_path: Path) -> None:
    folder = str(tmp_path / "set")
    result = CliRunner().invoke(app, ["train", folder, folder, "--head-only", "--out", str(tmp_path / "run")])
    assert result.exit_code == 1
    assert "add --from WEIGHTS" in result.output
