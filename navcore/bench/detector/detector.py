"""`rowpilot bench detector`: our detector and the published ones on the same rendered frames of unseen farms."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from navcore.bench.detector.frames import Cell, FrameParams, render_cells
from navcore.bench.detector.net_time import run_times, yolo_sized
from navcore.errors import InputError
from navcore.perception.box_decoding import DecodingParams
from navcore.perception.onnx_detector import WEIGHTS
from navcore.training.architecture_choice import load_trained
from navcore.training.average_precision import Found
from navcore.training.evaluate import Scores, detect_all, score
from navcore.training.scored_detector import scored_detector

OURS, SIZED = "ours", "YOLOv8n-sized"
THRESHOLD = DecodingParams().threshold


@dataclass(frozen=True, slots=True, kw_only=True)
class DetectorBenchParams:
    """Attributes:
    frames: how many.
    rounds: of timing.
    variants: folder with the published detectors' weights, NAME.pt of `rowpilot train` or NAME.onnx; None: without.
    """

    frames: FrameParams = FrameParams()
    rounds: int = 60
    variants: Path | None = None


QUICK = DetectorBenchParams(frames=FrameParams(farms=1), rounds=15)


@dataclass(frozen=True, slots=True, kw_only=True)
class CellScores:
    """Attributes: cell: the frames. by_detector: scores on them, by name."""

    cell: Cell
    by_detector: Mapping[str, Scores]


@dataclass(frozen=True, slots=True, kw_only=True)
class DetectorResult:
    """Attributes:
    cells: the nine.
    overall: scores on the frames of all cells together, by name.
    seconds: per picture, by name, that of `SIZED` among them; medians of `rounds`.
    """

    cells: tuple[CellScores, ...]
    overall: Mapping[str, Scores]
    seconds: Mapping[str, float]
    rounds: int


def run_bench(params: DetectorBenchParams, folder: Path, progress: Callable[[str], None]) -> DetectorResult:
    """Render, detect, time; pictures and converted weights go to `folder`. Raises InputError, ModelError."""
    models = {OURS: WEIGHTS, **dict(_variants(params.variants, folder))}
    found: dict[str, list[Found]] = {name: [] for name in models}
    cells = []
    for cell in render_cells(folder, params.frames):
        cells.append(_scored(cell, models, found))
        told = ", ".join(f"{name} {one.map50:.3f}" for name, one in cells[-1].by_detector.items())
        progress(f"{cell.stage}, {cell.light}: mAP50 {told}")
    labels = [sample.labels for one in cells for sample in one.cell.samples]
    return DetectorResult(
        cells=tuple(cells), rounds=params.rounds,
        overall={name: score(name, found[name], labels, THRESHOLD) for name in models},
        seconds=run_times({**models, SIZED: yolo_sized(folder)}, rounds=params.rounds),
    )  # fmt: skip


def _scored(cell: Cell, models: Mapping[str, Path], found: Mapping[str, list[Found]]) -> CellScores:
    """Of all detectors; what they find is added to `found`."""
    labels, scores = [sample.labels for sample in cell.samples], {}
    for name, path in models.items():
        own = detect_all(scored_detector(path), cell.samples)
        found[name].extend(own)
        scores[name] = score(name, own, labels, THRESHOLD)
    return CellScores(cell=cell, by_detector=scores)


def _variants(given: Path | None, folder: Path) -> Iterator[tuple[str, Path]]:
    """Names and ONNX files of the published detectors, those of torch converted."""
    if given is None:
        return
    weights = sorted([*given.glob("*.pt"), *given.glob("*.onnx")])
    if not weights:
        raise InputError(
            f"There are no weights (*.pt, *.onnx) in {given}; train some with `rowpilot train --net eca`."
        )
    for path in weights:
        yield path.stem, path if path.suffix == ".onnx" else _converted(path, folder)


def _converted(path: Path, folder: Path) -> Path:
    architecture, net = load_trained(path)
    architecture.export(net, folder / f"{path.stem}.onnx")
    return folder / f"{path.stem}.onnx"
