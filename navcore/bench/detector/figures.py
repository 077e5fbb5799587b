"""The figures of `rowpilot bench detector`, beside what papers A and B published and what is wanted."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from navcore.bench.detector.detector import OURS, SIZED, CellScores, DetectorResult
from navcore.bench.detector.frames import SEED
from navcore.bench.figure import Figure, share
from navcore.sim.camera_light import LightName
from navcore.sim.orchard import Season

# Paper A, Table 4: mAP by growth stage and illumination.
_PAPER_MAP = {
    (Season.BUDDING, LightName.NOON): 0.934, (Season.BUDDING, LightName.AFTERNOON): 0.957,
    (Season.BUDDING, LightName.EVENING): 0.919, (Season.GROWING, LightName.NOON): 0.873,
    (Season.GROWING, LightName.AFTERNOON): 0.932, (Season.GROWING, LightName.EVENING): 0.896,
    (Season.MATURING, LightName.NOON): 0.885, (Season.MATURING, LightName.AFTERNOON): 0.922,
    (Season.MATURING, LightName.EVENING): 0.906,
}  # fmt: skip
# Paper B, Table 2: YOLOv8-ResCBAM.
_PAPER_RECALL, _PAPER_PRECISION = 0.925, 0.910
_WANTED_MAP, _WANTED_SHARE, _WANTED_TIME = 0.97, 0.97, 1 / 6


def detector_figures(result: DetectorResult) -> tuple[Figure, ...]:
    """Ours first, the published ones beside it as baseline and each by itself."""
    names = [OURS, *(name for name in result.overall if name != OURS)]
    return tuple(
        figure for name in names for figure in (
            *(_map_figure(name, cell) for cell in result.cells), *_share_figures(name, result), *_times(name, result)
        )
    )  # fmt: skip


def _map_figure(name: str, cell: CellScores) -> Figure:
    mine, where = cell.by_detector[name], cell.cell
    target = _WANTED_MAP if name == OURS else None
    value = mine.map50 if np.isfinite(mine.map50) else None
    return Figure(
        figure=f"mAP50, {where.stage}, {where.light}, {name}", value=value, unit="share", n=mine.pictures,
        seed=where.seed, paper=_PAPER_MAP[where.stage, where.light], baseline=_best_other(name, cell), target=target,
        ok=_met(value, target), table="Paper A, Table 4: detection by growth stage and light",
    )  # fmt: skip


def _best_other(name: str, cell: CellScores) -> float | None:
    """The best published detector's mAP50 on the frames, beside ours."""
    values = [one.map50 for other, one in cell.by_detector.items() if other != OURS and np.isfinite(one.map50)]
    return max(values, default=None) if name == OURS else None


def _share_figures(name: str, result: DetectorResult) -> Iterator[Figure]:
    scores = result.overall[name]
    hits, feet = scores.hits, scores.feet
    yield _share(f"recall of boxes, {name}", hits.true, hits.asked, name, paper=_PAPER_RECALL)
    yield _share(f"precision of boxes, {name}", hits.true, hits.meant, name, paper=_PAPER_PRECISION)
    for what, value in (("recall", feet.recall), ("precision", feet.precision)):
        yield Figure(figure=f"{what} of feet within 8 px, {name}", value=value, unit="share", n=hits.asked, seed=SEED)


def _share(figure: str, part: int, whole: int, name: str, *, paper: float) -> Figure:
    """At the working threshold, an overlap of one half, the right class."""
    target = _WANTED_SHARE if name == OURS else None
    return share(
        figure, part, whole, seed=SEED, paper=paper, at_least=target, table="Paper B, Table 2: detection of trunks"
    )


def _times(name: str, result: DetectorResult) -> Iterator[Figure]:
    seconds, n = result.seconds[name], result.rounds
    ratio, target = seconds / result.seconds[SIZED], _WANTED_TIME if name == OURS else None
    yield Figure(figure=f"time per 640x384 frame on one thread, {name}", value=seconds, unit="s", n=n, seed=None,
                 baseline=result.seconds[SIZED])  # fmt: skip
    yield Figure(figure=f"that time over a YOLOv8n-sized network's, {name}", value=ratio, unit="1", n=n, seed=None,
                 baseline=1.0, target=target, ok=None if target is None else ratio <= target)  # fmt: skip


def _met(value: float | None, target: float | None) -> bool | None:
    return None if target is None or value is None else value >= target
