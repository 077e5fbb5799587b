"""The detectors' bench: every stage and light on farms of its own, the published beside ours, and who is faster."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from navcore.bench.detector.detector import OURS, SIZED, CellScores, DetectorBenchParams, DetectorResult, run_bench
from navcore.bench.detector.figures import detector_figures
from navcore.bench.detector.frames import LIGHTS, STAGES, Cell, FrameParams, render_cells
from navcore.bench.detector.net_time import run_times, yolo_sized
from navcore.cli import app
from navcore.errors import InputError
from navcore.perception.onnx_detector import WEIGHTS
from navcore.sim.camera_light import LightName
from navcore.sim.orchard import Season
from navcore.training.average_precision import Found
from navcore.training.dataset import SHOTS_PER_SCENE
from navcore.training.evaluate import Scores, score
from navcore.training.samples import Labels

BOXES = np.array([[10.0, 10.0, 20.0, 60.0], [40.0, 10.0, 50.0, 60.0]])
LABELS = Labels(boxes=BOXES, kinds=np.array([0, 1]), ignore=np.array([False, False]))


def scores(name: str, found: int) -> Scores:
    """Of a detector that finds so many of the two objects of a picture."""
    kinds = np.array([0, 1])[:found]
    return score(name, [Found(boxes=BOXES[:found], confidence=np.full(found, 0.9), kinds=kinds)], [LABELS], 0.3)


def result() -> DetectorResult:
    by_detector = {OURS: scores(OURS, 2), "eca": scores("eca", 1)}
    cell = CellScores(
        cell=Cell(stage=Season.GROWING, light=LightName.NOON, seed=7, samples=()), by_detector=by_detector
    )
    seconds = {OURS: 0.008, "eca": 0.05, SIZED: 0.05}
    return DetectorResult(cells=(cell,), overall=by_detector, seconds=seconds, rounds=5)


def test_the_figures_set_ours_beside_the_paper_and_the_best_published_one() -> None:
    by_name = {f.figure: f for f in detector_figures(result())}
    mine = by_name["mAP50, growing, noon, ours"]
    assert (mine.value, mine.paper, mine.baseline, mine.ok, mine.seed) == (1.0, 0.873, 0.5, True, 7)
    assert by_name["mAP50, growing, noon, eca"].ok is None
    recall = by_name["recall of boxes, eca"]
    assert (recall.value, recall.n) == (0.5, 2)
    assert recall.low is not None
    assert recall.low < 0.5
    speed = by_name["that time over a YOLOv8n-sized network's, ours"]
    assert speed.value == pytest.approx(0.16)
    assert speed.ok


def test_a_slower_or_blinder_detector_misses_its_targets() -> None:
    worse = replace(result(), overall={OURS: scores(OURS, 1)}, seconds={OURS: 0.01, SIZED: 0.05})
    by_name = {f.figure: f for f in detector_figures(worse)}
    assert by_name["recall of boxes, ours"].ok is False
    assert by_name["precision of boxes, ours"].ok is True
    assert by_name["that time over a YOLOv8n-sized network's, ours"].ok is False


def test_each_stage_and_light_is_rendered_as_it_says_on_a_farm_of_its_own(tmp_path: Path) -> None:
    cells = []
    for cell in render_cells(tmp_path, FrameParams(farms=1)):
        cells.append(cell)
        if len(cells) == 2:
            break
    assert [(c.stage, c.light) for c in cells] == [(STAGES[0], LIGHTS[0]), (STAGES[0], LIGHTS[1])]
    for cell in cells:
        assert len(cell.samples) == SHOTS_PER_SCENE
        assert {(s.season, s.light) for s in cell.samples} == {(str(cell.stage), str(cell.light))}
    assert cells[0].seed != cells[1].seed


def test_ours_and_a_network_of_yolos_size_are_timed_side_by_side(tmp_path: Path) -> None:
    """How much faster ours is, the bench tells: on a computer that does other things a test cannot."""
    seconds = run_times({OURS: WEIGHTS, SIZED: yolo_sized(tmp_path)}, rounds=3)
    assert 0.0 < seconds[OURS] < seconds[SIZED]


def test_a_folder_without_weights_is_refused_with_a_sentence(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no weights"):
        run_bench(DetectorBenchParams(variants=tmp_path), tmp_path, lambda _: None)


def test_the_verb_says_so_too(tmp_path: Path) -> None:
    told = CliRunner().invoke(app, ["bench", "detector", "--quick", "--variants", str(tmp_path)])
    assert told.exit_code == 2
    assert "rowpilot train" in told.output


def test_figures_are_plain_json() -> None:
    from navcore.cli.figure_lines import report as _report

    rows = json.loads(_report(detector_figures(result()), "c", "m"))
    assert {"figure", "value", "unit", "n", "seed", "paper", "baseline", "target", "ok"} <= set(rows[0])
