"""What `rowpilot bench rows` counts, on a handful of frames."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.bench.figure import Figure
from navcore.bench.fit_time import fit_times
from navcore.bench.no_row_frames import NoRow, count_false_lines
from navcore.bench.row_end_error import end_errors
from navcore.bench.row_entries import count_entries
from navcore.bench.rows import RowsBenchParams, run_bench
from navcore.bench.rows_figures import rows_figures
from navcore.geometry.pinhole import robot_camera
from navcore.perception.row_perception import RowMethod

CAMERA = robot_camera()
FEW = RowsBenchParams(
    drives=1, end_drives=4, farms=1, frames=3, entry_farms=1, entries=3, stage_farms=1, stage_frames=2, rounds=30
)


@pytest.fixture(scope="module")
def figures() -> dict[str, Figure]:
    return {one.figure: one for one in rows_figures(run_bench(FEW, lambda _: None))}


def test_every_figure_has_a_value_and_says_on_how_much_it_rests(figures: dict[str, Figure]) -> None:
    assert all(one.value is not None and math.isfinite(one.value) and one.n > 0 for one in figures.values())


def test_what_is_wanted_is_judged_and_stands_beside_the_published_method(figures: dict[str, Figure]) -> None:
    judged = [one for one in figures.values() if one.target is not None]
    assert len(judged) == 14
    assert all(one.ok is not None for one in judged)
    assert all(one.baseline is not None for one in judged if not one.figure.startswith("error of the row's end"))


def test_lines_are_counted_where_there_is_no_row_and_only_there() -> None:
    """Least squares draws a line through anything that stands about in a turn."""
    counts = count_false_lines(CAMERA, (RowMethod.LEAST_SQUARES, RowMethod.CORRIDOR), farms=2, frames=20, seed=7)
    assert {kind: count.frames for kind, count in counts[RowMethod.CORRIDOR].items()} == dict.fromkeys(NoRow, 40)
    invented = {method: sum(count.seen for count in kinds.values()) for method, kinds in counts.items()}
    assert invented[RowMethod.LEAST_SQUARES] > invented[RowMethod.CORRIDOR]


def test_the_end_is_told_to_half_a_metre() -> None:
    errors = end_errors(CAMERA, drives=6, seed=7)
    assert np.isfinite(errors).all()
    assert np.median(np.abs(errors)) < 0.5  # m


def test_the_same_seed_gives_the_same_entries() -> None:
    once, again = (count_entries(CAMERA, RowMethod.CORRIDOR, farms=1, entries=3, seed=7) for _ in range(2))
    assert once == again
    assert once.tried == 3


def test_our_fit_finds_the_line_as_often_as_the_published_one() -> None:
    times = fit_times(rounds=60, seed=7)
    assert times["ours"].right >= times["RANSAC as published"].right
    assert times["ours"].right >= 57
