"""What the pose graph is worth: a long U, its legs on either side of one line of posts, mapped with less and less.

Posts near each other are seen from one place, so the surveyed distances come out right however a drive drifts. A
drift shows in distances of a whole row's length, and in how far apart the line between the legs stands by the way out
and by the way back: a map in which it stands twice.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from navcore.bench.figure import Figure
from navcore.bench.lidar3d.block_run import BlockRun, block_run
from navcore.bench.lidar3d.mapped_posts import mapped_posts
from navcore.bench.lidar3d.mapping_distances import Distances, distances, laid_on
from navcore.geometry.se3 import SE3
from navcore.mapping.lidar3d.keyframe import Keyframe
from navcore.mapping.lidar3d.map_maker import MapMaker, MapMakerParams
from navcore.mapping.lidar3d.work_folder import WorkFolder
from navcore.sim.block_drive import BlockDriveParams
from navcore.sim.block_survey import surveyed_distances
from navcore.sim.lidar3d import C16
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, scoring_block

Floats = NDArray[np.float64]
Tell = Callable[[str], None]
FAR_M = 30.0
SEED = 10_011
_BLOCK = 5
# Every second ray, and as fast as the robot goes: what is benched is drift, not sharpness.
_LIDAR = replace(C16, columns=900)


@dataclass(frozen=True, slots=True, kw_only=True)
class ClosureParams:
    """How much.

    Attributes:
        length: of a row, m. seasons: of the drives; in full leaf RTK floats under the canopy.
        begin_m: where fixes end that are there at the begin only, m driven.
    """

    length: float = 96.0
    seasons: tuple[Season, ...] = (Season.GROWING,)
    begin_m: float = 20.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Closed:
    """One way of mapping the U.

    Attributes:
        far: distances of more than 30 m. apart: (N,) of a post by the way out and by the way back, m. poses_off: (K,)
        of the keyframes from the truth, in the plane, m.
    """

    name: str
    far: Distances
    apart: Floats
    poses_off: Floats


def closures(params: ClosureParams, folder: Path, tell: Tell) -> list[tuple[Season, Closed]]:
    """Every way of mapping one drive in each season; keyframes are made once."""
    found = []
    for season in params.seasons:
        block = scoring_block(_BLOCK, BlockSize(alleys=3, length=params.length))
        tell(f"{block.site.name}: a U of {params.length:.0f} m, {season}")
        drive = BlockDriveParams(seed=SEED, rows=(0, 1), season=season, speed=1.5, lidar=_LIDAR)
        found += [(season, closed) for closed in _ways(block_run(block, drive), params, folder / season.value, tell)]
    return found


def _ways(run: BlockRun, params: ClosureParams, folder: Path, tell: Tell) -> list[Closed]:
    work = WorkFolder(folder / "all", run.drive.name, "bench")
    closed: list[Closed] = []
    for name, begin_only, drive, rounds in (
        ("graph with fixes and loops", False, run.drive, 2),
        ("graph with fixes, no loops", False, run.drive, 0),
        ("graph with fixes at the begin and loops", True, run.drive, 2),
        ("graph with fixes at the begin, no loops", True, run.drive, 0),
        ("graph with loops, no fixes", False, replace(run.drive, datum=None), 2),
    ):
        own = _fixes_until(work, params.begin_m, folder / f"begin {rounds}", run) if begin_only else work
        made = MapMaker(drive, own, replace(MapMakerParams(), rounds=rounds)).make()
        keyframes = own[:]
        truth = [run.truth[k.stamp_ns] for k in keyframes]
        if not closed:
            chained = laid_on([k.T_odom_base for k in keyframes], truth)
            closed.append(_closed("scans laid one on the other, no graph", run, keyframes, chained))
        # A map without a place on the Earth is laid on the truth as a whole.
        poses = made.poses if made.report.georeferenced else laid_on(made.poses, truth)
        closed.append(_closed(name, run, keyframes, poses))
        tell(f"{name}: {100.0 * closed[-1].apart.mean():.1f} cm apart")
    return closed


def _fixes_until(work: WorkFolder, way: float, folder: Path, run: BlockRun) -> WorkFolder:
    """The same keyframes, with fixes on so much of the way only."""
    fewer = WorkFolder(folder, run.drive.name, "bench")
    for keyframe in work:
        fewer.append(keyframe if keyframe.driven < way else replace(keyframe, fix=None))
    return fewer


def _closed(name: str, run: BlockRun, keyframes: Sequence[Keyframe], poses: Sequence[SE3]) -> Closed:
    whole = distances(mapped_posts(keyframes, poses, run.posts), surveyed_distances(run.posts, reach=1e3))
    half = sum(k.driven < keyframes[-1].driven / 2.0 for k in keyframes)
    out, back = (mapped_posts(keyframes[leg], poses[leg], run.posts) for leg in (slice(0, half), slice(half, None)))
    apart = np.hypot(*(out - back).T)
    off = [np.hypot(*(T.t - run.truth[k.stamp_ns].t)[:2]) for k, T in zip(keyframes, poses, strict=True)]
    return Closed(
        name=name, far=whole.where(whole.true > FAR_M), apart=apart[np.isfinite(apart)], poses_off=np.array(off)
    )  # fmt: skip


def closure_figures(found: Sequence[tuple[Season, Closed]]) -> list[Figure]:
    """Mean and largest of each way."""
    return [figure for season, closed in found for figure in _of(season, closed)]


def _of(season: Season, closed: Closed) -> list[Figure]:
    rows = (
        ("distances over 30 m", np.abs(closed.far.errors)), ("posts by the way out and back apart", closed.apart),
        ("keyframes off the truth", closed.poses_off),
    )  # fmt: skip
    return [
        Figure(figure=f"long U, {season}, {closed.name}: {words}, {statistic}", n=len(values), seed=SEED, unit="m",
               value=float(value(values)) if len(values) else None)
        for words, values in rows
        for statistic, value in (("mean", np.mean), ("largest", np.max))
    ]  # fmt: skip
