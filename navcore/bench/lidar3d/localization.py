"""`rowpilot bench localization`: paper C's fixed points by RTK, by the 3D map, and by both, in every season.

The map is made of a drive in winter by `MapMaker`; other drives follow in winter, spring and full leaf. Blocks are
scoring blocks (odd seeds); parameters were set on tuning blocks. A wrong place is a recorded drive whose matches lie
aside from one moment on: scored is how soon the witnesses (`localization.map_watch`) take the trust from them. Then
robots are switched on anywhere in the blocks without GNSS, told roughly where they stand, or nothing.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import islice
from pathlib import Path

import numpy as np

from navcore.bench.figure import Figure, share
from navcore.bench.lidar3d.bad_input import CASES, SEED, BadInput, case_figures, file_figures, heard
from navcore.bench.lidar3d.block_run import block_run
from navcore.bench.lidar3d.following import followed, led
from navcore.bench.lidar3d.following_figures import following_figures
from navcore.bench.lidar3d.localization_drive import Placed, localized
from navcore.bench.lidar3d.ndt_rivals import following_rivals
from navcore.bench.lidar3d.ndt_scans import NdtScanParams, ndt_scans
from navcore.bench.lidar3d.restart_figures import Restarts, restart_figures, restarts
from navcore.geometry.se2 import SE2
from navcore.localization.lidar3d.map_watch import MapWatch
from navcore.mapping.lidar3d.map_maker import MadeMap, MapMaker
from navcore.mapping.lidar3d.work_folder import WorkFolder
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.messages import MatchState
from navcore.sim.block_drive import BlockDriveParams
from navcore.sim.block_survey import fixed_points
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, PearBlock, scoring_block

Tell = Callable[[str], None]
SEASONS = {Season.DORMANT: "winter", Season.BUDDING: "spring", Season.GROWING: "full leaf"}
# Paper C at 1.0 m/s, lateral m and heading deg: RTK alone, and with NDT; what is wanted of ours.
PAPER = {"lateral mean": 0.05, "lateral SD": 0.02, "heading mean": 1.0, "heading SD": 0.6}
WANTED = {"lateral mean": 0.02, "lateral SD": 0.01, "heading mean": 0.3, "heading SD": 0.2}
NOTICED_S, WRONG_M = 1.0, (0.3, 3.0)
_MAP_SEED, _DRIVE_SEED, _WRONG_SEED, _RIVAL_SEED = 10_001, 20_001, 30_001, 40_001


@dataclass(frozen=True, slots=True, kw_only=True)
class LocalizationBenchParams:
    """How much.

    Attributes:
        blocks: each mapped once. size: of a block. rows: that are driven. drives: in each season. wrong: places put
            wrong in all. restarts: robots switched on in each season and block.
        bad, bad_drives, bad_turns: cases of bad input, drives of each, and turns of the LiDAR in each.
        followed, followed_rows, followed_scans: seasons in which the rivals follow a drive on the first block's map,
            its rows, and its scans at most.
    """

    blocks: int = 2
    size: BlockSize = BlockSize(alleys=4, length=72.0)
    rows: tuple[int, ...] = (0, 1)
    drives: int = 1
    wrong: int = 200
    followed: tuple[Season, ...] = tuple(SEASONS)
    followed_rows: tuple[int, ...] = (0, 1)
    followed_scans: int | None = None
    bad_drives: int = 3
    bad_turns: int = 300
    bad: tuple[BadInput, ...] = CASES
    restarts: int = 12


QUICK = LocalizationBenchParams(
    blocks=1, size=BlockSize(alleys=2, length=24.0), wrong=50, followed=(Season.DORMANT,),
    followed_rows=(0,), followed_scans=150, bad_drives=1, bad_turns=120,
    bad=tuple(case for case in CASES if not case.whole), restarts=2,
)  # fmt: skip


def run_bench(params: LocalizationBenchParams, tell: Tell) -> tuple[Figure, ...]:
    """All figures."""
    again: dict[Season, list[Restarts]] = {season: [] for season in SEASONS}
    driven: dict[Season, list[tuple[PearBlock, list[Placed]]]] = {season: [] for season in SEASONS}
    rivals: list[Figure] = []
    for number in range(params.blocks):
        block = scoring_block(number, params.size)
        tell(f"block {block.seed}: its map")
        made = mapped(block, params.rows)
        for season in SEASONS:
            for drive in range(params.drives):
                tell(f"block {block.seed}, {SEASONS[season]}, drive {drive + 1}")
                case = BlockDriveParams(seed=_DRIVE_SEED + drive, season=season, rows=params.rows)
                driven[season].append((block, list(localized(block, case, made.ndt))))
            tell(f"block {block.seed}, {SEASONS[season]}, restarts")
            again[season] += restarts(block, season, made.ndt, params.restarts, tell)
        if number == 0:
            rivals += rival_figures(block, params, made, tell)
            rivals += bad_input_figures(block, params, made.ndt, tell)
    figures = [f for season, drives in driven.items() for f in season_figures(SEASONS[season], drives, params.rows)]
    figures += [f for season, found in again.items() for f in restart_figures(SEASONS[season], found)]
    trust = trust_figures([placed for drives in driven.values() for _, placed in drives], params.wrong)
    return (*figures, *trust, *rivals)


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


def bad_input_figures(block: PearBlock, params: LocalizationBenchParams, own: NdtMap, tell: Tell) -> list[Figure]:
    """Each case, and each file."""
    foreign = ndt_scans(NdtScanParams(block=params.blocks + 1, size=params.size, scans=0)).ndt_map
    figures = file_figures(own, SEED)
    for case in params.bad:
        tell(f"block {block.seed}: {case.name}")
        drives = [
            list(heard(block, case, foreign if case.foreign else own, params.bad_turns, SEED + drive,
                       BlockDriveParams()))
            for drive in range(params.bad_drives)
        ]  # fmt: skip
        figures += case_figures(case, drives, SEED)
    return figures


def season_figures(
    season: str, drives: Sequence[tuple[PearBlock, list[Placed]]], rows: tuple[int, ...]
) -> list[Figure]:  # fmt: skip
    """Errors at the fixed points of one season, RTK and the map alone beside both."""
    errors = {way: at_fixed_points(drives, rows, way) for way in ("fused", "rtk", "map")}
    figures = []
    for name, paper in PAPER.items():
        told = {way: _statistic(name, found) for way, found in errors.items()}
        value, unit = told["fused"], "m" if name.startswith("lateral") else "deg"
        figures.append(Figure(
            figure=f"{season}: {name} at the fixed points", value=value, unit=unit, n=len(errors["fused"]),
            seed=_DRIVE_SEED, paper=paper, baseline=told["rtk"], target=WANTED[name],
            ok=None if value is None else value <= WANTED[name],
        ))  # fmt: skip
        figures.append(Figure(
            figure=f"{season}: {name}, the map alone", value=told["map"], unit=unit, n=len(errors["map"]),
            seed=_DRIVE_SEED, paper=paper, baseline=told["rtk"],
        ))  # fmt: skip
    whole = sum(len(fixed_points(tuple(block.site.rows[i] for i in rows))) for block, _ in drives)
    figures.append(share(f"{season}: fixed points with a place", len(errors["fused"]), whole, seed=_DRIVE_SEED))
    return figures


def at_fixed_points(
    drives: Sequence[tuple[PearBlock, list[Placed]]], rows: tuple[int, ...], way: str
) -> list[tuple[float, float]]:  # fmt: skip
    """(lateral, heading) error where the robot truly passes each point, m and rad."""
    found = []
    for block, placed in drives:
        for point in fixed_points(tuple(block.site.rows[i] for i in rows)):
            nearest = min(placed, key=lambda p: math.hypot(p.truth.x - point.x, p.truth.y - point.y))
            told = _told(nearest, way)
            if told is not None:
                off = nearest.truth.inverse() @ told
                found.append((off.y, off.yaw))
    return found


def _told(placed: Placed, way: str) -> SE2 | None:
    if way != "map":
        return placed.fused if way == "fused" else placed.rtk
    match = placed.match
    return SE2(match.x, match.y, match.yaw) if match.state is MatchState.MATCHED else None


def _statistic(name: str, errors: list[tuple[float, float]]) -> float | None:
    if not errors:
        return None
    which, scale = (0, 1.0) if name.startswith("lateral") else (1, 180.0 / math.pi)
    values = scale * np.array(errors)[:, which]
    return float(np.abs(values).mean() if name.endswith("mean") else np.abs(values).std())


def trust_figures(drives: Sequence[list[Placed]], count: int) -> list[Figure]:
    """How soon wrong places are noticed, and how often right ones are doubted."""
    rng = np.random.default_rng(_WRONG_SEED)
    usable = [d for d in drives if sum(p.believed for p in d) > 60]
    times = [_noticed_s(usable[k % len(usable)], rng) for k in range(count)] if usable else []
    alarms, hours = sum(map(_alarms, drives)), sum(d[-1].stamp_ns - d[0].stamp_ns for d in drives if d) / 3.6e12
    slowest = max((t for t in times if math.isfinite(t)), default=None)
    soon = sum(t <= NOTICED_S for t in times)
    return [
        share("wrong place noticed within 1.0 s", soon, len(times), seed=_WRONG_SEED, at_least=1.0),
        Figure(figure="slowest to be noticed", value=slowest, unit="s", n=len(times), seed=_WRONG_SEED),
        Figure(
            figure="false alarms an hour", value=alarms / hours if hours else None, unit="1/h", n=len(drives),
            seed=_DRIVE_SEED, target=1.0, ok=alarms <= max(1.0, hours) if hours else None,
        ),
    ]  # fmt: skip


def _noticed_s(placed: list[Placed], rng: np.random.Generator) -> float:
    """A drive whose matches lie aside from a moment on; s until they are not believed, infinite if never."""
    begin = int(rng.integers(20, len(placed) - 20))
    way, turn = rng.uniform(*WRONG_M), rng.uniform(-math.pi, math.pi)
    aside = SE2(way * math.cos(turn), way * math.sin(turn), rng.uniform(-0.2, 0.2))
    watch = MapWatch()
    for p in placed[:begin]:
        watch.add_match(p.match, p.T_odom_base)
    for p in placed[begin:]:
        wrong = SE2(p.match.x, p.match.y, p.match.yaw) @ aside
        if not watch.add_match(replace(p.match, x=wrong.x, y=wrong.y, yaw=wrong.yaw), p.T_odom_base):
            return (p.stamp_ns - placed[begin].stamp_ns) * 1e-9
    return math.inf


def _alarms(placed: list[Placed]) -> int:
    """Times that right matches lost the trust of the wheels."""
    watch, alarms, before = MapWatch(), 0, ""
    for p in placed:
        watch.add_match(p.match, p.T_odom_base)
        alarms, before = alarms + bool(watch.reason and not before), watch.reason
    return alarms
