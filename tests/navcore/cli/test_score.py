"""`rowpilot score FOLDER`: the shipped detector on a rendered set, as the model card tells it."""

from __future__ import annotations

from pathlib import Path

from typer.testing import CliRunner

from navcore.cli import app
from navcore.training.dataset import render_dataset

runner = CliRunner()


def test_the_shipped_detector_is_scored_on_any_set(tmp_path: Path) -> None:
    render_dataset(tmp_path, count=12, seed=77)
    result = runner.invoke(app, ["score", str(tmp_path)])
    assert result.exit_code == 0, result.stderr
    head, whole, *_ = result.stdout.splitlines()
    assert head.split()[:5] == ["set", "pictures", "mAP50", "recall", "precision"]
    name, pictures, _, recall, precision, *_ = whole.split()
    assert (name, pictures) == ("all", "12")
    assert float(recall) > 0.6
    assert float(precision) > 0.7


def test_a_folder_that_is_no_set_and_weights_that_are_none_are_refused(tmp_path: Path) -> None:
    for arguments in ([str(tmp_path)], [str(tmp_path), "--weights", str(tmp_path / "none.onnx")]):
        result = runner.invoke(app, ["score", *arguments])
        assert result.exit_code == 2
        assert "There is no" in result.stderr
