"""The figures of paper B's drives, beside what it published and what is wanted."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import chain as joined
from statistics import median

import numpy as np
from numpy.typing import NDArray

from navcore.bench import paper_b
from navcore.bench.figure import Figure, share
from navcore.bench.fusion.segment_cases import Chain
from navcore.bench.fusion.segment_drive import SegmentResult
from navcore.bench.fusion.tree_matches import TreeMatches
from navcore.bench.paper_b import Tracking

Floats = NDArray[np.float64]

WITHIN_M = 0.10
WANTED = Tracking(0.020, 0.025, 0.995)
WANTED_FOUND, WANTED_WRONG, WANTED_THICKNESS_M = 0.98, 0.01, 0.01
PAPER = {
    Chain.OURS: paper_b.FUSED, Chain.PUBLISHED: paper_b.FUSED, Chain.LIDAR: paper_b.LIDAR_RANSAC,
    Chain.VISION: paper_b.VISION_RANSAC, Chain.SEGMENTATION: paper_b.SEGMENTATION,
}  # fmt: skip
TABLE = "Paper B, Tables 5 and 6: lateral deviation"


def drive_figures(results: tuple[SegmentResult, ...]) -> tuple[Figure, ...]:
    """Lateral deviation of every chain, then the trees."""
    seed = results[0].case.young().seed if results else None
    by_chain = {c: [r for r in results if r.case.chain is c] for c in Chain}
    tracked = {c: tracking(r.off for r in found) for c, found in by_chain.items() if found}
    lines = [f for c in tracked for f in _lateral(c, tracked[c], tracked.get(Chain.PUBLISHED), by_chain[c], seed)]
    ours = by_chain[Chain.OURS]
    return (*lines, *_as_planted(ours, seed), *_tree_figures(ours, seed), *_look_time(ours, seed))


def tracking(deviations: Iterable[tuple[float | None, ...]]) -> Tracking:
    """Mean and RMS over all stations that were passed, m; within 10 cm of all stations, not reached ones included."""
    told = list(joined.from_iterable(deviations))
    off = np.abs(np.array([e for e in told if e is not None], dtype=np.float64))
    if not len(off):
        return Tracking(float("nan"), float("nan"), 0.0)
    within = int(np.count_nonzero(off <= WITHIN_M)) / len(told)
    return Tracking(float(np.mean(off)), float(np.sqrt(np.mean(off**2))), within)


def _lateral(
    chain: Chain, found: Tracking, published: Tracking | None, results: list[SegmentResult], seed: int | None
) -> list[Figure]:
    """Mean, RMS, share within 10 cm; ours is judged."""
    judged, paper = chain is Chain.OURS, PAPER.get(chain)
    n = sum(len(r.off) for r in results)
    figures = []
    for i, (name, unit) in enumerate((("mean", "m"), ("RMS", "m"), ("within 10 cm", "share"))):
        value = None if np.isnan(found[i]) else found[i]
        ok = None
        if judged and value is not None:
            ok = value >= WANTED[i] if name == "within 10 cm" else value <= WANTED[i]
        figures.append(
            Figure(
                figure=f"lateral {name}, {chain}", value=value, unit=unit, n=n, seed=seed,
                paper=paper[i] if paper else None, baseline=published[i] if judged and published else None,
                target=WANTED[i] if judged else None, ok=ok, table=TABLE,
            )
        )  # fmt: skip
    return figures


def _as_planted(results: list[SegmentResult], seed: int | None) -> list[Figure]:
    """From where the middle was meant to be, which nobody can see: trees stand 10 cm about it."""
    mean, n = tracking(r.planned for r in results).mean, sum(len(r.planned) for r in results)
    name = "lateral mean from the middle as it was meant to be planted, ours"
    value = None if np.isnan(mean) else mean
    return [Figure(figure=name, value=value, unit="m", n=n, seed=seed, table=TABLE)] if results else []


def _tree_figures(results: list[SegmentResult], seed: int | None) -> list[Figure]:
    ours = _sum(r.ours for r in results)
    theirs = _sum(r.published for r in results)
    pairs = ours.right + ours.wrong
    errors = np.abs(np.array(ours.thickness))
    thickness = float(np.mean(errors)) if len(errors) else None
    return [
        share("trees that the camera knows, placed by the scan, ours", ours.found, ours.trees, seed=seed,
              paper=paper_b.ASSOCIATED, baseline=theirs.found / max(theirs.trees, 1), at_least=WANTED_FOUND),
        share("places that are another tree's or none's, ours", ours.wrong, pairs, seed=seed,
              baseline=theirs.wrong / max(theirs.right + theirs.wrong, 1), at_most=WANTED_WRONG),
        Figure(figure="trunk diameter passed at 1 to 2 m, mean error, ours", value=thickness, unit="m",
               n=len(errors), seed=seed, target=WANTED_THICKNESS_M,
               ok=None if thickness is None else thickness <= WANTED_THICKNESS_M),
    ]  # fmt: skip


def _look_time(results: list[SegmentResult], seed: int | None) -> list[Figure]:
    """The drives' medians, and their median: in the middle of pictures that are drawn, on all cores."""
    ours, theirs = [r.look_ms for r in results if r.look_ms], [r.published_ms for r in results if r.published_ms]
    name = "from scan and boxes to the row between the drives' pictures, median, ours"
    return [
        Figure(
            figure=name, value=median(ours) if ours else None, unit="ms", n=len(ours), seed=seed,
            baseline=median(theirs) if theirs else None,
        )
    ] if results else []  # fmt: skip


def _sum(found: Iterable[TreeMatches | None]) -> TreeMatches:
    all_of = [m for m in found if m is not None]
    return TreeMatches(
        trees=sum(m.trees for m in all_of), found=sum(m.found for m in all_of), right=sum(m.right for m in all_of),
        wrong=sum(m.wrong for m in all_of), thickness=tuple(joined.from_iterable(m.thickness for m in all_of)),
    )  # fmt: skip
