"""The bench of paper B's drives: what is counted, and one drive through a segment."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from navcore.bench.fusion.figures import drive_figures, tracking
from navcore.bench.fusion.fusion import DRIVES, QUICK_DRIVES, drive_all, read_drives
from navcore.bench.fusion.look_time import look_time_figures
from navcore.bench.fusion.segment_cases import Chain, SegmentCase, SegmentCaseParams, segment_cases
from navcore.bench.fusion.segment_drive import STATIONS, SegmentResult
from navcore.bench.fusion.tree_matches import Tally, known_tree
from navcore.bench.mission.cases import EyeKind
from navcore.cli import app
from navcore.errors import ConfigError
from navcore.sim.camera_light import LightName
from navcore.sim.young_orchard import Segment

CASE = SegmentCase(
    chain=Chain.OURS, segment=Segment.STRAIGHT, run=0, speed=1.0, light=LightName.NOON, eye=EyeKind.TRUTH, tuning=True
)  # fmt: skip


def result(*off: float | None, chain: Chain = Chain.OURS) -> SegmentResult:
    case = SegmentCase(chain=chain, segment=Segment.STRAIGHT, run=0, speed=1.0, light=LightName.NOON)
    return SegmentResult(case=case, off=off, planned=off, why="")


def test_every_chain_drives_the_same_orchards_at_the_same_speeds_in_the_same_light() -> None:
    cases = segment_cases(SegmentCaseParams())
    assert len(cases) == len(set(cases)) == 5 * 10 * len(Chain)
    by_chain = [{(c.segment, c.run, c.speed, c.light) for c in cases if c.chain is chain} for chain in Chain]
    assert all(drives == by_chain[0] for drives in by_chain)
    assert {c.speed for c in cases if c.segment is Segment.OFFSET} == {0.5 + 1.5 * i / 9 for i in range(10)}
    assert len({c.light for c in cases}) == 5


def test_orchards_that_are_scored_on_are_not_tuned_on() -> None:
    tuned = {c.young().seed for c in segment_cases(SegmentCaseParams(tuning=True))}
    assert not tuned & {c.young().seed for c in segment_cases(SegmentCaseParams())}


def test_a_station_that_was_not_reached_is_no_success_and_no_deviation() -> None:
    found = tracking([(0.05, -0.15), (0.0, None)])
    assert found.mean == pytest.approx(0.2 / 3)
    assert found.rms == pytest.approx(np.sqrt((0.05**2 + 0.15**2) / 3))
    assert found.success == pytest.approx(2 / 4)


def test_a_tree_counts_as_placed_once_it_was_in_three_pictures() -> None:
    tally = Tally()
    for place in (7, 7, None, 3):
        tally.add(7, place)
    assert (tally.matches().trees, tally.matches().found, tally.matches().wrong) == (1, 0, 1)
    tally.add(7, 7)
    assert (tally.matches().found, tally.matches().right) == (1, 3)


def test_a_box_about_a_tree_too_far_away_to_count_is_not_taken_for_the_near_one_before_it() -> None:
    near_foot, far_foot = (106.0, 206.0), (100.0, 190.0)
    feet, near = np.array((near_foot, (300.0, 250.0), far_foot)), np.array((True, True, False))
    assert known_tree(feet, near, (300.0, 252.0)) == 1
    assert known_tree(feet, near, (101.0, 198.0)) is None
    assert known_tree(feet[:2], near[:2], (101.0, 198.0)) == 0


def test_ours_is_judged_and_stands_beside_the_published_one() -> None:
    figures = drive_figures((result(0.01, -0.03), result(0.06, 0.06, chain=Chain.PUBLISHED)))
    ours = next(f for f in figures if f.figure == "lateral mean, ours")
    assert ours.value == pytest.approx(0.02)
    assert ours.baseline == pytest.approx(0.06)
    assert (ours.paper, ours.ok) == (0.052, True)
    assert next(f for f in figures if f.figure == "lateral mean, fusion as published").ok is None


def test_a_segment_is_driven_close_to_its_middle_and_kept(tmp_path: Path) -> None:
    (driven,) = drive_all((CASE,), tmp_path, 1, lambda line: None)
    assert driven.why == ""
    assert all(off is not None for off in driven.off)
    assert len(driven.off) == len(STATIONS)
    assert tracking([driven.off]).mean < 0.10  # m: what paper B counts as driven well
    assert driven.ours is not None
    assert driven.published is not None
    assert driven.ours.trees == driven.published.trees
    assert driven.ours.found > driven.published.found
    assert driven.ours.found / driven.ours.trees > 0.75
    told = {f.figure: f for f in drive_figures((driven,))}
    look = told["from scan and boxes to the row between the drives' pictures, median, ours"]
    assert (look.value, look.baseline) == (driven.look_ms, driven.published_ms)
    assert 0.0 < (driven.look_ms or 0.0) < 1000.0  # ms
    again = drive_all((CASE,), tmp_path, 1, lambda line: pytest.fail("driven twice"))
    assert again == (driven,)
    with (tmp_path / DRIVES).open("a") as file:
        file.write('{"torn')
    assert list(read_drives(tmp_path / DRIVES)) == [CASE]


def test_the_quick_drives_are_two_a_chain() -> None:
    assert len(segment_cases(QUICK_DRIVES)) == 2 * len(Chain)


def test_the_segmentation_drives_by_pictures_even_where_the_others_get_the_truth() -> None:
    cases = segment_cases(replace(QUICK_DRIVES, eye=EyeKind.TRUTH))
    assert {(c.chain is Chain.SEGMENTATION, c.eye) for c in cases} == {(True, EyeKind.PIXELS), (False, EyeKind.TRUTH)}
    with pytest.raises(ConfigError, match="pictures alone"):
        replace(CASE, chain=Chain.SEGMENTATION)


def test_the_segmentation_stands_beside_what_paper_b_published_of_it() -> None:
    figures = drive_figures((result(0.05, -0.07, chain=Chain.SEGMENTATION),))
    told = {f.figure: f for f in figures if "skeleton" in f.figure}
    mean, within = (told[f"lateral {name}, segmentation + skeleton"] for name in ("mean", "within 10 cm"))
    assert mean.value == pytest.approx(0.06)
    assert (mean.paper, within.value, within.paper) == (0.069, 1.0, 0.870)


def test_the_looks_of_a_drive_are_timed_again_when_it_is_over() -> None:
    (figure,) = look_time_figures(CASE)
    assert figure.n > 100
    assert 0.0 < (figure.value or 0.0) < 1000.0  # ms
    assert 0.0 < (figure.baseline or 0.0) < 1000.0  # ms


def test_a_chain_that_nobody_knows_is_refused_with_those_there_are() -> None:
    told = CliRunner().invoke(app, ["bench", "fusion", "--chain", "theirs"])
    assert told.exit_code == 2
    assert "There is no chain theirs" in told.output
    assert '"true trunks"' in told.output
