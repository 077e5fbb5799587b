"""`rowpilot train-ground` says what is wrong before it renders for minutes."""

from __future__ import annotations

from pathlib import Path

import pytest
from typer.testing import CliRunner

from navcore.cli import app


def test_a_folder_that_is_not_there_is_named_first(tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["train-ground", str(tmp_path / "nowhere" / "ground.onnx")])
    assert done.exit_code == 1
    assert "There is no folder" in done.output
    assert "pictures" not in done.output


@pytest.mark.parametrize("wrong", [("--epochs", "0"), ("--plantings", "0"), ("--shots", "-1"), ("--seed", "-1")])
def test_counts_and_seeds_that_make_no_sense_are_refused(wrong: tuple[str, str]) -> None:
    assert CliRunner().invoke(app, ["train-ground", *wrong]).exit_code == 2
