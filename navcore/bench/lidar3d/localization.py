"""`rowpilot bench localization`: paper C's fixed points by RTK, by the 3D map, and by both, in every season.

The map is made of a drive in winter by `MapMaker`; other drives follow in winter, spring and full leaf. Blocks are
scoring blocks (odd seeds); parameters were set on tuning blocks. Then robots are switched on anywhere in the blocks
without GNSS, told roughly where they stand, or nothing.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path

from navcore.bench.figure import Figure
from navcore.bench.lidar3d.bad_input import (
    CASES,
    SEED,
    BadInput,
    BadInputDrive,
    Heard,
    case_figures,
    drive_badly,
    file_figures,
)
from navcore.bench.lidar3d.block_run import block_run
from navcore.bench.lidar3d.error_boxes import error_boxes
from navcore.bench.lidar3d.false_alarm_figures import false_alarm_figures
from navcore.bench.lidar3d.fixed_point_figures import SEASONS, Drives, season_figures
from navcore.bench.lidar3d.following import followed, led
from navcore.bench.lidar3d.following_figures import following_figures
from navcore.bench.lidar3d.ndt_rivals import following_rivals
from navcore.bench.lidar3d.ndt_scans import NdtScanParams, ndt_scans
from navcore.bench.lidar3d.restart_figures import Restarts, restart_figures, restart_words
from navcore.bench.lidar3d.season_drives import SeasonCase, drive_season
from navcore.bench.lidar3d.trust_figures import trust_figures
from navcore.bench.lidar3d.watched_drives import Watched, WatchParams, watch, watched_cases
from navcore.bench.side_by_side import side_by_side
from navcore.mapping.lidar3d.map_maker import MadeMap, MapMaker
from navcore.mapping.lidar3d.work_folder import WorkFolder
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.sim.block_drive import BlockDriveParams
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, PearBlock, scoring_block

Tell = Callable[[str], None]
_MAP_SEED, _RIVAL_SEED = 10_001, 40_001


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalizationBenchParams:
    """How much.

    Attributes:
        blocks: each mapped once. size: of a block. rows: that are driven. drives: in each season. wrong: places put
            wrong in all. watch: healthy drives besides. restarts: robots switched on in each season and block.
        bad, bad_drives, bad_turns: cases of bad input, drives of each, and turns of the LiDAR in each.
        followed, followed_rows, followed_scans: seasons in which the rivals follow a drive on the first block's map,
            its rows, and its scans at most.
    """

    blocks: int = 2
    size: BlockSize = BlockSize(alleys=4, length=72.0)
    rows: tuple[int, ...] = (0, 1)
    drives: int = 1
    wrong: int = 200
    watch: WatchParams = field(default_factory=WatchParams)
    followed: tuple[Season, ...] = tuple(SEASONS)
    followed_rows: tuple[int, ...] = (0, 1)
    followed_scans: int | None = None
    bad_drives: int = 3
    bad_turns: int = 300
    bad: tuple[BadInput, ...] = CASES
    restarts: int = 12


QUICK = LocalizationBenchParams(
    blocks=1, size=BlockSize(alleys=2, length=24.0), wrong=50, watch=WatchParams(laps=((1.5, 1),)),
    followed=(Season.DORMANT,), followed_rows=(0,), followed_scans=150, bad_drives=1, bad_turns=120,
    bad=tuple(case for case in CASES if not case.whole), restarts=2,
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalizationScores:
    """All figures, and the errors at the fixed points as box plots, an SVG drawing."""

    figures: tuple[Figure, ...]
    boxes: str


def run_bench(params: LocalizationBenchParams, tell: Tell, processes: int = 1) -> LocalizationScores:
    """Block by block, its drives side by side in so many processes; what is timed has the machine to itself."""
    again: dict[Season, list[Restarts]] = {season: [] for season in SEASONS}
    driven: Drives = {season: [] for season in SEASONS}
    rivals: list[Figure] = []
    watched: list[Watched] = []
    for number in range(params.blocks):
        block = scoring_block(number, params.size)
        tell(f"block {block.seed}: its map")
        made = mapped(block, params.rows)
        for found in side_by_side(drive_season, season_cases(block, params, made.ndt), processes):
            driven[found.season] += [(block, drive) for drive in found.drives]
            again[found.season] += found.restarts
            tell(f"block {block.seed}, {SEASONS[found.season]}: {restart_words(found.restarts)}")
        for seen in side_by_side(watch, watched_cases(block, number, made.ndt, params.rows, params.watch), processes):
            watched.append(seen)
            tell(f"block {block.seed}, {SEASONS[seen.season]}: watched for {seen.hours:.2f} h, {_alarms(seen)}")
        if number == 0:
            rivals += rival_figures(block, params, made, tell)
            rivals += bad_input_figures(block, params, made.ndt, tell, processes)
    figures = [f for season, drives in driven.items() for f in season_figures(SEASONS[season], drives, params.rows)]
    figures += [f for season, found in again.items() for f in restart_figures(SEASONS[season], found)]
    trust = trust_figures([placed for drives in driven.values() for _, placed in drives], params.wrong)
    trust += false_alarm_figures(watched)
    return LocalizationScores(figures=(*figures, *trust, *rivals), boxes=error_boxes(driven, params.rows))


def _alarms(seen: Watched) -> str:
    return f"false alarms: {'; '.join(seen.alarms)}" if seen.alarms else "no false alarm"


def season_cases(block: PearBlock, params: LocalizationBenchParams, own: NdtMap) -> list[SeasonCase]:
    """One a season."""
    return [
        SeasonCase(
            block=block, season=season, ndt_map=own, rows=params.rows, drives=params.drives, restarts=params.restarts
        )
        for season in SEASONS
    ]


def mapped(block: PearBlock, rows: tuple[int, ...]) -> MadeMap:
    """The block's map of a drive in winter."""
    run = block_run(block, BlockDriveParams(seed=_MAP_SEED, rows=rows))
    with tempfile.TemporaryDirectory() as folder:
        return MapMaker(run.drive, WorkFolder(Path(folder), run.drive.name, "bench")).make()


def rival_figures(block: PearBlock, params: LocalizationBenchParams, made: MadeMap, tell: Tell) -> list[Figure]:
    """Ours and others on the same drives, each on the same map's cells or points."""
    figures = []
    for season in params.followed:
        tell(f"block {block.seed}, {SEASONS[season]}: the rivals follow")
        case = BlockDriveParams(seed=_RIVAL_SEED, season=season, rows=params.followed_rows)
        turns = islice(led(block, case), params.followed_scans)
        followers = followed(turns, following_rivals(made.ndt, made.cloud.points))
        figures += following_figures(SEASONS[season], followers, _RIVAL_SEED)
    return figures


def bad_input_figures(
    block: PearBlock, params: LocalizationBenchParams, own: NdtMap, tell: Tell, processes: int
) -> list[Figure]:  # fmt: skip
    """Each case, and each file."""
    foreign = ndt_scans(NdtScanParams(block=params.blocks + 1, size=params.size, scans=0)).ndt_map
    drives = [
        BadInputDrive(block=block, case=case, ndt_map=foreign if case.foreign else own, turns=params.bad_turns,
                      seed=SEED + drive)
        for case in params.bad
        for drive in range(params.bad_drives)
    ]  # fmt: skip
    heard: dict[str, list[list[Heard]]] = {case.name: [] for case in params.bad}
    for name, turns in side_by_side(drive_badly, drives, processes):
        heard[name].append(turns)
        tell(f"block {block.seed}: {name}")
    return [*file_figures(own, SEED), *(f for case in params.bad for f in case_figures(case, heard[case.name], SEED))]
