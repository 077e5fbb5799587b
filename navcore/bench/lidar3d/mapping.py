"""`rowpilot bench mapping`: maps of simulated pear blocks in winter, beside what paper C says of its own.

Parameters were set on tuning blocks (even seeds); the figures are of scoring blocks (odd seeds). The baseline is the
published way on the same scans: each laid on the map of those before, without graph, loops or priors; its map is laid
on the truth as a whole first, as nothing else says where it lies.
"""

from __future__ import annotations

import math
import resource
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from navcore.bench.figure import Figure
from navcore.bench.lidar3d.block_run import BlockRun, block_run
from navcore.bench.lidar3d.mapped_posts import mapped_posts
from navcore.bench.lidar3d.mapping_closure import ClosureParams
from navcore.bench.lidar3d.mapping_distances import Distances, distances, laid_on
from navcore.bench.lidar3d.mapping_growth import grown_map_bytes
from navcore.geometry.se3 import SE3
from navcore.mapping.lidar3d.map_maker import MadeMap, MapMaker, MapMakerParams
from navcore.mapping.lidar3d.work_folder import WorkFolder
from navcore.sim.block_drive import BlockDriveParams
from navcore.sim.block_survey import surveyed_distances
from navcore.sim.pear_block import BlockSize, PearBlock, scoring_block

Floats = NDArray[np.float64]
Tell = Callable[[str], None]
PAPER_MEAN_M, PAPER_WORST_M, PAPER_CV = 0.03, 0.11, 0.02
MEAN_M, WORST_M, CV, TURNS_A_SECOND = 0.01, 0.03, 0.005, 20.0
HECTARES = (0.1, 1.0, 10.0)
_SEED = 10_001


@dataclass(frozen=True, slots=True, kw_only=True)
class MappingBenchParams:
    """How much.

    Attributes:
        blocks: that are mapped, each by one drive. size: of a block. rows: that are driven, two make a U.
        hectares: areas of which the memory is told. closure: a long U, mapped with less and less; None for none.
    """

    blocks: int = 3
    size: BlockSize = BlockSize(alleys=4, length=72.0)
    rows: tuple[int, ...] = (0, 1, 2, 3)
    hectares: tuple[float, ...] = HECTARES
    closure: ClosureParams | None = field(default_factory=ClosureParams)


QUICK = MappingBenchParams(
    blocks=1, size=BlockSize(alleys=2, length=24.0), rows=(0, 1), hectares=(0.1, 1.0),
    closure=None,
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MappedBlock:
    """One block, mapped.

    Attributes:
        ours, baseline: distances in either map. poses_off: (K,) of the keyframes from the truth, in the plane, m.
        made: the map. turns_a_second: by the processor time of all of mapping, on one core.
        map_bytes: by hectares.
    """

    ours: Distances
    baseline: Distances
    poses_off: Floats
    made: MadeMap
    turns_a_second: float
    map_bytes: dict[float, int]


def run_bench(params: MappingBenchParams, tell: Tell) -> list[MappedBlock]:
    """Map the blocks one after another."""
    mapped = []
    for i in range(params.blocks):
        block = scoring_block(i, params.size)
        tell(f"{block.site.name}: driving")
        run = block_run(block, BlockDriveParams(seed=_SEED + 2 * i, rows=params.rows))
        tell(f"{block.site.name}: mapping {len(run.truth)} turns")
        with tempfile.TemporaryDirectory(prefix="rowpilot-mapping-") as folder:
            mapped.append(_mapped(block, run, Path(folder) / "work", params))
        tell(f"{block.site.name}: mean {1e3 * mapped[-1].ours.mean:.1f} mm")
    return mapped


def _mapped(block: PearBlock, run: BlockRun, folder: Path, params: MappingBenchParams) -> MappedBlock:
    maker, work = MapMakerParams(), WorkFolder(folder, run.drive.name, "bench")
    began = time.process_time()
    made = MapMaker(run.drive, work, maker).make()
    spent = time.process_time() - began
    keyframes = work[:]
    truth = [run.truth[k.stamp_ns] for k in keyframes]
    chained = laid_on([k.T_odom_base for k in keyframes], truth)
    surveyed = surveyed_distances(run.posts)
    ours, baseline = (
        distances(mapped_posts(keyframes, poses, run.posts), surveyed) for poses in (made.poses, chained)
    )  # fmt: skip
    T_block_map = SE3.from_rpy((0.0, 0.0, 0.0), yaw=-_heading(block))
    laid, area = [T_block_map @ T for T in made.poses], _driven([T_block_map @ T for T in truth])
    return MappedBlock(
        ours=ours, baseline=baseline, poses_off=_off(made.poses, truth), made=made,
        turns_a_second=made.report.turns / spent,
        map_bytes={h: grown_map_bytes(keyframes, laid, area, h, maker.ndt) for h in params.hectares},
    )  # fmt: skip


def mapping_figures(mapped: Sequence[MappedBlock]) -> tuple[Figure, ...]:
    """The table."""
    ours, baseline = (Distances.joined([getattr(m, name) for m in mapped]) for name in ("ours", "baseline"))
    seed = _SEED
    figures = [*_distances("all", ours, baseline, seed)]
    for words, along in (("along rows", True), ("across rows", False)):
        own, base = (d.where(d.along == along) for d in (ours, baseline))
        figures += _distances(words, own, base, seed, judged=False)
    off = np.concatenate([m.poses_off for m in mapped])
    turns = float(np.median([m.turns_a_second for m in mapped]))
    return (
        *figures,
        _plain("surveyed distances of which a post was not found", float(ours.lost), "count", len(ours.errors), seed),
        _plain("keyframes from the truth, mean", float(off.mean()), "m", len(off), seed),
        Figure(
            figure="mapping, scans a second of processor time, one core", value=turns, unit="1/s", n=len(mapped),
            seed=seed, target=TURNS_A_SECOND, ok=turns >= TURNS_A_SECOND,
        ),
        *_means(mapped, seed),
        *_memory(mapped, seed),
    )  # fmt: skip


def _means(mapped: Sequence[MappedBlock], seed: int) -> list[Figure]:
    """Of a map."""
    reports = [m.made.report for m in mapped]
    seen, loops = ([getattr(r, name) for r in reports] for name in ("hectares", "loops_taken"))
    return [
        _plain("area seen by one map", float(np.mean(seen)), "ha", len(mapped), seed),
        _plain("loops believed in one map", float(np.mean(loops)), "count", len(mapped), seed),
    ]


def _distances(words: str, ours: Distances, baseline: Distances, seed: int, judged: bool = True) -> list[Figure]:
    rows = (
        ("mean absolute error", ours.mean, baseline.mean, "m", PAPER_MEAN_M, MEAN_M),
        ("largest absolute error", ours.worst, baseline.worst, "m", PAPER_WORST_M, WORST_M),
        ("CV", ours.variation, baseline.variation, "share", PAPER_CV, CV),
    )  # fmt: skip
    return [
        Figure(
            figure=f"map distances, {words}: {name}", value=value, unit=unit, n=len(ours.errors), seed=seed,
            paper=paper, baseline=base, target=target if judged else None, ok=value <= target if judged else None,
            table="Paper C, Table 2",
        )
        for name, value, base, unit, paper, target in rows
    ]  # fmt: skip


def _memory(mapped: Sequence[MappedBlock], seed: int) -> list[Figure]:
    """Of the map alone, and what the whole process had at its worst."""
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    return [
        *(
            _plain(f"NDT map of {h:g} ha", float(np.mean([m.map_bytes[h] for m in mapped])) / 1e6 / h, "MB/ha",
                   len(mapped), seed)
            for h in mapped[0].map_bytes
        ),
        _plain("memory of bench, drive and mapping at its most", peak, "MB", len(mapped), seed),
    ]  # fmt: skip


def _plain(figure: str, value: float, unit: str, n: int, seed: int) -> Figure:
    return Figure(figure=figure, value=value, unit=unit, n=n, seed=seed)


def _off(poses: Sequence[SE3], truth: Sequence[SE3]) -> Floats:
    return np.array([np.hypot(*(T.t - G.t)[:2]) for T, G in zip(poses, truth, strict=True)])


def _heading(block: PearBlock) -> float:
    """Of its rows, rad."""
    (x0, y0), (x1, y1) = block.site.rows[0].start, block.site.rows[0].end
    return math.atan2(y1 - y0, x1 - x0)


def _driven(truth: Sequence[SE3]) -> Floats:
    """The rectangle about what was driven: x0, y0, x1, y1."""
    places = np.array([T.t[:2] for T in truth])
    return np.concatenate((places.min(axis=0), places.max(axis=0)))
