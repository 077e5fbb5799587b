"""What `rowpilot bench rows` counts, on a handful of frames."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.bench.figure import Figure
from navcore.bench.rows.ablations import ablations
from navcore.bench.rows.end_error import end_errors
from navcore.bench.rows.entries import count_entries
from navcore.bench.rows.figures import rows_figures
from navcore.bench.rows.fit_time import fit_times
from navcore.bench.rows.no_row_frames import NoRow, count_false_lines
from navcore.bench.rows.recorded_rows import RecordedRowsParams
from navcore.bench.rows.rows import RowsBenchParams, run_bench
from navcore.bench.rows.valid_frames import count_frames, method_fitter
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


@pytest.mark.parametrize("name", sorted(ablations(CAMERA)))
def test_a_fit_without_one_of_its_parts_still_finds_the_lines_of_a_clean_picture(name: str) -> None:
    clean = RecordedRowsParams(
        frames=20, drop_out=0.0, burst=0.0, false_boxes=0.0, edge_px=0.0, foot_lift=0.0, scatter=0.0, pitch_deg=0.0
    )
    counts = count_frames(ablations(CAMERA)[name], CAMERA, drives=1, seed=1, rows=clean).row
    assert (counts.true, counts.abstained) == (20, 0)


def test_each_part_of_the_fit_is_worth_something_in_bad_pictures() -> None:
    whole = count_frames(method_fitter(RowMethod.CORRIDOR, CAMERA), CAMERA, drives=1, seed=7).row
    alone = count_frames(ablations(CAMERA)["without tracking and joint fit"], CAMERA, drives=1, seed=7).row
    assert alone.frames == whole.frames
    assert alone.true < whole.true


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
