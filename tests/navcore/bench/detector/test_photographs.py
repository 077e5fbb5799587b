"""Photographs with marked rows are scored by the lines and feet that are seen in them."""

from __future__ import annotations

import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from navcore.bench.detector.photographs import Photograph, photograph_figures, read_photographs
from navcore.errors import InputError


def folder(path: Path, *labels: dict[str, object]) -> Path:
    """A grey picture for each label."""
    noise = np.random.default_rng(1).normal(120, 12, (360, 640, 3))
    for label in labels:
        cv2.imwrite(str(path / str(label["file"])), np.clip(noise, 0, 255).astype(np.uint8))
    (path / "labels.json").write_text(json.dumps(labels))
    return path


def test_where_nothing_stands_no_row_is_seen_and_a_marked_one_is_missed(tmp_path: Path) -> None:
    objects = [{"box": [20, 30, 40, 200], "foot_visible": True}, {"box": [1, 2, 3, 9], "foot_visible": False}]
    lines_there = {"left": [[9, 350], [300, 90]], "right": [[630, 350], [340, 90]]}
    marked = {"file": "a.png", "in_row": True, **lines_there, "objects": objects}
    lines, false, feet = photograph_figures(folder(tmp_path, marked, {"file": "b.png", "in_row": False}))
    assert (lines.value, lines.n, lines.ok) == (0.0, 1, False)
    assert (false.value, false.n, false.ok) == (0.0, 1, True)
    assert (feet.value, feet.n) == (0.0, 1)


def test_what_nobody_could_tell_is_not_counted(tmp_path: Path) -> None:
    lines, false, _ = photograph_figures(folder(tmp_path, {"file": "a.png", "in_row": "unclear"}))
    assert (lines.value, lines.n, false.value, false.n) == (None, 0, None, 0)


@pytest.mark.parametrize("text", ["", "{}", '[{"file": 3}]', '[{"file": "a.png", "in_row": true, "left": [1]}]'])
def test_labels_that_are_none_are_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "labels.json").write_text(text)
    with pytest.raises(InputError, match="no list of marked photographs"):
        photograph_figures(tmp_path)


def test_a_missing_photograph_or_list_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"labels.json cannot be read"):
        photograph_figures(tmp_path)
    (tmp_path / "labels.json").write_text('[{"file": "gone.png", "in_row": false}]')
    with pytest.raises(InputError, match=r"gone.png is missing or damaged"):
        photograph_figures(tmp_path)


def test_real_rows_are_seen_better_than_in_whole_pictures(shared_data: Path) -> None:
    lines, false, feet = photograph_figures(shared_data / "frames")
    assert lines.ok
    assert false.value == 0.0
    for figure in (lines, feet):
        assert figure.value is not None
        assert figure.baseline is not None
        assert figure.value > figure.baseline
    assert all(isinstance(one, Photograph) for one, _ in read_photographs(shared_data / "frames"))
