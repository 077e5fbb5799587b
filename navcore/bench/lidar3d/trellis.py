"""The trellis reference on simulated pear blocks: by season, of all seasons, and where half the posts are gone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from navcore.bench.figure import Figure, share
from navcore.bench.lidar3d.trellis_rows import row_figures
from navcore.bench.lidar3d.trellis_runs import TrellisRun, TrellisRunParams, trellis_run
from navcore.bench.lidar3d.trellis_scores import PostScore, score_posts, score_wires, still_reported
from navcore.mapping.trellis.published_filters import published_posts, published_trellis
from navcore.mapping.trellis.trellis_reference import TrellisReference, places_of, trellis_reference
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, PearBlock, scoring_block

Floats = NDArray[np.float64]
Tell = Callable[[str], None]

TABLE = "Trellis reference (simulated Y-trellis pear block)"
HALF = 0.5
_FOUND, _RMS_M = 0.98, 0.02
YEAR = (Season.DORMANT, Season.BUDDING, Season.GROWING, Season.MATURING, Season.AUTUMN)


@dataclass(frozen=True, slots=True, kw_only=True)
class TrellisBenchParams:
    """What is measured: the block by its number, its runs, and the seasons in which they are driven."""

    block: int = 0
    runs: TrellisRunParams = field(default_factory=lambda: TrellisRunParams(size=BlockSize(alleys=4, length=48.0)))
    seasons: tuple[Season, ...] = YEAR


QUICK = TrellisBenchParams(
    runs=TrellisRunParams(size=BlockSize(alleys=2, length=24.0), columns=720, every=1.0),
    seasons=(Season.DORMANT, Season.MATURING),
)


def trellis_figures(params: TrellisBenchParams = TrellisBenchParams(), tell: Tell = lambda _: None) -> list[Figure]:
    """All figures, the published filters' beside ours on the same clouds."""
    block = scoring_block(params.block, params.runs.size)
    runs, figures = [], []
    for season in params.seasons:
        tell(f"Driving through the block, {season.value}")
        run = trellis_run(block, season, params.runs)
        runs.append(run)
        figures += _season_figures(block, run, season.value, tell)
    tell("Half of the posts are gone")
    half = trellis_run(block, params.seasons[0], params.runs, posts_gone=HALF)
    figures += _season_figures(block, half, f"{half.season.value}, half of the posts gone", tell)
    tell("All runs together")
    return figures + _together(block, runs, half, tell)


def _season_figures(block: PearBlock, run: TrellisRun, name: str, tell: Tell) -> list[Figure]:
    reference = trellis_reference([run.cloud], cells=False)
    ours = score_posts(places_of(reference.posts), run.standing)
    theirs = score_posts(_published(block, reference, run), run.standing)
    tell(f"  {name}: ours {ours.found} of {ours.true}, {ours.false} false; filters {theirs.found}, {theirs.false}")
    return _post_figures(name, ours, theirs, block.seed) + _wire_figures(name, reference, run, block.seed)


def _together(block: PearBlock, runs: list[TrellisRun], half: TrellisRun, tell: Tell) -> list[Figure]:
    clouds, begun = [run.cloud for run in runs], perf_counter()
    reference = trellis_reference(clouds, tell=lambda step: tell(f"  {step}"))
    seconds = perf_counter() - begun
    ours = score_posts(places_of(reference.posts), runs[0].standing)
    figures = _post_figures("all seasons", ours, None, block.seed)
    figures += _wire_figures("all seasons", reference, runs[0], block.seed)
    figures += _trunk_figures(reference, runs[0], block.seed)
    figures += [
        _plain("time for all seasons", seconds, "s", len(runs), block.seed),
        _plain("cells of 0.2 m that persist", float(len(reference.cells.centres)) if reference.cells else None, "1",
               len(runs), block.seed),
    ]  # fmt: skip
    tell("Rows and missions on the found map")
    figures += row_figures(block, reference, clouds, "all seasons")
    newest = trellis_reference([*clouds, half.cloud], cells=False)
    left = score_posts(places_of(newest.posts), half.standing)
    reported = still_reported(places_of(newest.posts), half.gone)
    figures += _post_figures("all seasons, then half of the posts gone", left, None, block.seed)
    figures.append(
        share("posts that are gone and still reported", reported, len(half.gone), seed=block.seed, at_most=0.02,
              table=TABLE)
    )  # fmt: skip
    return figures + row_figures(block, newest, [*clouds, half.cloud], "half of the posts gone")


def _published(block: PearBlock, reference: TrellisReference, run: TrellisRun) -> Floats:
    """The paper's filters, told where the rows' lines are, as its authors told them by hand."""
    lines: list[tuple[Floats, Floats]] = []
    for row in block.site.rows:
        begin, end = np.array(row.start), np.array(row.end)
        unit = (end - begin) / np.linalg.norm(end - begin)
        left = np.array((-unit[1], unit[0])) * row.width / 2
        lines += [(begin + side * left, end + side * left) for side in (1.0, -1.0)]
    return published_posts(published_trellis(run.cloud.points, reference.ground, lines))


def _post_figures(name: str, ours: PostScore, theirs: PostScore | None, seed: int) -> list[Figure]:
    rms, theirs_rms = ours.rms, theirs.rms if theirs else None
    return [
        share(f"posts found, {name}", ours.found, ours.true, seed=seed, at_least=_FOUND, table=TABLE,
              baseline=theirs.found / theirs.true if theirs else None),
        Figure(figure=f"false posts, {name}", value=float(ours.false), unit="1", n=ours.true, seed=seed, target=0.0,
               ok=ours.false == 0, baseline=float(theirs.false) if theirs else None, table=TABLE),
        Figure(figure=f"error of a post, RMS, {name}", value=rms, unit="m", n=ours.found, seed=seed, target=_RMS_M,
               ok=None if rms is None else rms <= _RMS_M, baseline=theirs_rms, table=TABLE),
    ]  # fmt: skip


def _wire_figures(name: str, reference: TrellisReference, run: TrellisRun, seed: int) -> list[Figure]:
    found, true, false = score_wires(reference.wires, run.wires)
    return [
        share(f"wire found, by length, {name}", found, true, seed=seed, table=TABLE),
        _plain(f"false wires, {name}", float(false), "1", len(reference.wires), seed),
    ]


def _trunk_figures(reference: TrellisReference, run: TrellisRun, seed: int) -> list[Figure]:
    score = score_posts(places_of(reference.trunks), run.trunks)
    return [
        share("trunks found, all seasons", score.found, score.true, seed=seed, table=TABLE),
        _plain("false trunks, all seasons", float(score.false), "1", score.true, seed),
    ]


def _plain(figure: str, value: float | None, unit: str, n: int, seed: int) -> Figure:
    return Figure(figure=figure, value=value, unit=unit, n=n, seed=seed, table=TABLE)
