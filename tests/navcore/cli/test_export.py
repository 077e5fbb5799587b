"""`rowpilot export`: the file that the robot runs, in single precision and in 8 bits."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import onnx
import pytest
from typer.testing import CliRunner

from navcore.cli import app
from navcore.perception.onnx_detector import WEIGHTS, OnnxDetector, OnnxDetectorParams
from navcore.training.dataset import render_dataset
from navcore.training.evaluate import evaluate
from navcore.training.foot_architecture import FootArchitecture
from navcore.training.model import FootNetParams
from navcore.training.quantize import last_convolutions
from navcore.training.samples import read_samples
from navcore.training.scored_detector import scored_detector
from navcore.training.trainer import Trainer, TrainerParams
from tests.navcore.training.farm_pictures import draw_set

runner = CliRunner()
SMALL = TrainerParams(
    epochs=1, batch=4, device="cpu",
    architecture=FootArchitecture(params=FootNetParams(channels=(8, 8, 16, 16, 16), depths=(0, 1, 1, 1))),
)  # fmt: skip


@pytest.fixture(scope="module")
def rendered(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("rendered")
    render_dataset(folder, count=8, seed=78)
    return folder


def test_what_was_trained_becomes_the_robots_file(tmp_path: Path) -> None:
    draw_set(tmp_path / "set", 4, 1)
    samples = read_samples(tmp_path / "set")
    best = Trainer(tmp_path / "run", samples, samples, replace(SMALL)).run(lambda _: None)
    out = tmp_path / "mine.onnx"
    result = runner.invoke(app, ["export", str(best), "--out", str(out)])
    assert result.exit_code == 0, result.stderr
    assert "differs from torch by at most" in result.stdout
    assert OnnxDetector(OnnxDetectorParams(weights=out)).detect(samples[0].image()) is not None


def test_eight_bits_are_smaller_and_find_nearly_the_same(rendered: Path, tmp_path: Path) -> None:
    out = tmp_path / "small.onnx"
    result = runner.invoke(app, ["export", str(WEIGHTS), "--int8", str(rendered), "--out", str(out)])
    assert result.exit_code == 0, result.stderr
    assert result.stdout.count("mAP50") == 2
    assert out.stat().st_size < 0.5 * WEIGHTS.stat().st_size
    samples = read_samples(rendered)
    plain, small = (evaluate(scored_detector(path), samples, 0.3)[0].map50 for path in (WEIGHTS, out))
    assert small > plain - 0.1
    assert not list(tmp_path.glob("*.part*"))


def test_the_last_convolutions_keep_their_precision() -> None:
    graph = onnx.load(WEIGHTS).graph
    kept = last_convolutions(graph)
    assert 0 < len(kept) < sum(node.op_type == "Conv" for node in graph.node) / 4


@pytest.mark.parametrize("arguments", [["none.pt"], [str(WEIGHTS)], [str(WEIGHTS), "--int8", "."]])
def test_what_cannot_be_exported_is_refused_and_nothing_is_written(
    arguments: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    result = runner.invoke(app, ["export", *arguments, "--out", "out.onnx"])
    assert result.exit_code == 2
    assert result.stderr.strip()
    assert not list(tmp_path.iterdir())
