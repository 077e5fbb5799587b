"""Registration of one scan onto the map: time and error beside others on the same scans, from near and afar."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.bench.figure import Figure, share
from navcore.bench.interleaved import interleaved
from navcore.bench.lidar3d.ndt_rivals import OURS, OURS_WIDE, PUBLISHED, SMALL_GICP, Case, pose_of, rivals, started
from navcore.bench.lidar3d.ndt_scans import SEASONS, NdtScanParams, NdtScans, ndt_scans
from navcore.geometry.se3 import SE3
from navcore.localization.ndt.registration import Registration
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize

Floats = NDArray[np.float64]
Made = dict[str, list[Registration | SE3]]

NEAR, FAR = (0.3, math.radians(5.0)), (0.6, math.radians(10.0))
SEED = 5000
RIVALS = (OURS, OURS_WIDE, PUBLISHED, *SMALL_GICP)
_NAMES = {Season.DORMANT: "winter", Season.BUDDING: "spring", Season.MATURING: "full leaf"}
_RIGHT_M, _RIGHT_RAD, _EXACT_CM = 0.1, math.radians(1.0), 1.0
# A third of the time of the fastest other that is as exact.
_WANTED_RATIO = 1.0 / 3.0


@dataclass(frozen=True, slots=True, kw_only=True)
class NdtBenchParams:
    """What is measured.

    Attributes:
        blocks: that are scanned. Scoring blocks have odd seeds from 10,003 on; parameters were chosen on tuning block
            1, of seed 2, and on scenes of a plainer orchard.
        seed: of the starts.
    """

    blocks: tuple[NdtScanParams, ...] = (NdtScanParams(block=1), NdtScanParams(block=2))
    seed: int = SEED


QUICK = NdtBenchParams(blocks=(NdtScanParams(block=1, size=BlockSize(alleys=3, length=30.0), scans=10),))


@dataclass(slots=True)
class _Tally:
    """What the rivals made of all blocks' scans, by how far off they were started."""

    cases: dict[tuple[float, float], list[Case]] = field(default_factory=dict)
    made: dict[tuple[float, float], Made] = field(default_factory=dict)
    seconds: dict[str, list[float]] = field(default_factory=dict)
    maps: list[NdtMap] = field(default_factory=list)


def run_bench(params: NdtBenchParams, tell: Callable[[str], None]) -> tuple[Figure, ...]:
    """All figures; several minutes a block."""
    tally = _Tally()
    for block in params.blocks:
        tell(f"Block {block.block}: mapping and scanning")
        scans = ndt_scans(block)
        tell(f"Block {block.block}: registering {len(scans.scans)} scans")
        _register(scans, params.seed + block.block, tally)
    return ndt_figures(tally, params.seed)


def _register(scans: NdtScans, seed: int, tally: _Tally) -> None:
    measured = rivals(scans)
    tally.maps.append(scans.ndt_map)
    for start in (NEAR, FAR):
        cases = started(scans, *start, seed)
        winter = [case for case in cases if case.scan.season is Season.DORMANT]
        rest = [case for case in cases if case.scan.season is not Season.DORMANT]
        seconds, made = interleaved(measured, winter)
        _, more = interleaved(measured, rest)
        tally.cases.setdefault(start, []).extend((*winter, *rest))
        for name in measured:
            tally.made.setdefault(start, {}).setdefault(name, []).extend((*made[name], *more[name]))
            if start == NEAR:
                tally.seconds.setdefault(name, []).append(seconds[name])


def ndt_figures(tally: _Tally, seed: int) -> tuple[Figure, ...]:
    """In the order of a table: time and error, against the best of the others, from afar, and the map's size."""
    return (
        *_times(tally, seed), *_errors(tally, seed), *_against_the_best(tally, seed), *_from_afar(tally, seed),
        *_in_seasons(tally, seed), _covariance(tally, seed), _memory(tally, seed),
    )  # fmt: skip


def _of(tally: _Tally, start: tuple[float, float], season: Season, name: str) -> list[tuple[Case, SE3]]:
    made = tally.made[start].get(name, [])
    pairs = zip(tally.cases[start], made, strict=True) if made else ()
    return [(case, pose_of(one)) for case, one in pairs if case.scan.season is season]


def _off_cm(pairs: list[tuple[Case, SE3]]) -> Floats:
    return np.array([100.0 * float(np.linalg.norm(T.t - case.scan.T_map_lidar.t)) for case, T in pairs])


def _in_plan_cm(pairs: list[tuple[Case, SE3]]) -> Floats:
    return np.array([100.0 * float(np.linalg.norm((T.t - case.scan.T_map_lidar.t)[:2])) for case, T in pairs])


def _median(values: Floats) -> float | None:
    return float(np.median(values)) if len(values) else None


def _ms(tally: _Tally, name: str) -> float | None:
    return 1e3 * float(np.median(tally.seconds[name])) if name in tally.seconds else None


def _times(tally: _Tally, seed: int) -> list[Figure]:
    n = len(_of(tally, NEAR, Season.DORMANT, OURS))
    return [
        Figure(figure=f"one scan onto the map, {name}", value=_ms(tally, name), unit="ms", n=n, seed=seed)
        for name in RIVALS
    ]


def _errors(tally: _Tally, seed: int) -> list[Figure]:
    figures = []
    for name in RIVALS:
        off = _off_cm(_of(tally, NEAR, Season.DORMANT, name))
        figures.append(
            Figure(figure=f"median error in winter, {name}", value=_median(off), unit="cm", n=len(off), seed=seed)
        )
    return figures


def _against_the_best(tally: _Tally, seed: int) -> list[Figure]:
    """Of the others that reach 1 cm, the fastest."""
    exact = {
        name: (ms, off)
        for name in SMALL_GICP
        if (ms := _ms(tally, name)) is not None
        and (off := _median(_off_cm(_of(tally, NEAR, Season.DORMANT, name)))) is not None
        and off <= _EXACT_CM
    }
    n = len(_of(tally, NEAR, Season.DORMANT, OURS))
    ours_ms, ours_cm = _ms(tally, OURS), _median(_off_cm(_of(tally, NEAR, Season.DORMANT, OURS)))
    if not exact or ours_ms is None or ours_cm is None:
        why = (
            "small_gicp is not installed" if not any(s in tally.seconds for s in SMALL_GICP) else "none reaches 1 cm"
        )
        return [Figure(figure=f"time over small_gicp's ({why})", value=None, unit="ratio", n=0, seed=seed)]
    name, (ms, off) = min(exact.items(), key=lambda item: item[1][0])
    return [
        Figure(figure=f"time over that of {name}", value=ours_ms / ms, unit="ratio", n=n, seed=seed,
               target=_WANTED_RATIO, ok=ours_ms / ms <= _WANTED_RATIO),
        Figure(figure=f"error beside that of {name}", value=ours_cm, unit="cm", n=n, seed=seed, baseline=off,
               target=off, ok=ours_cm <= off),
    ]  # fmt: skip


def _right(case: Case, T: SE3) -> bool:
    error = case.scan.T_map_lidar.inverse() @ T
    return bool(np.linalg.norm(error.t) < _RIGHT_M) and error.angle() < _RIGHT_RAD


def _right_in_plan(case: Case, T: SE3) -> bool:
    """Grass lifts the ground, and with it what the height of a pose is measured by."""
    error = case.scan.T_map_lidar.se2().inverse() @ T.se2()
    return math.hypot(error.x, error.y) < _RIGHT_M and abs(error.yaw) < _RIGHT_RAD


def _from_afar(tally: _Tally, seed: int) -> list[Figure]:
    figures = []
    for name in RIVALS:
        pairs = _of(tally, FAR, Season.DORMANT, name)
        figures.append(
            share(f"right from 0.6 m and 10 deg, winter, {name}", sum(_right(*pair) for pair in pairs), len(pairs),
                  seed=seed, at_least=1.0 if name == OURS_WIDE else None)
        )  # fmt: skip
    return figures


def _in_seasons(tally: _Tally, seed: int) -> list[Figure]:
    """In plan, against a map of winter."""
    figures = []
    for season in SEASONS:
        for name in RIVALS:
            pairs, near = _of(tally, FAR, season, name), _of(tally, NEAR, season, name)
            judged = name == OURS_WIDE
            figures.append(
                share(f"right in plan from 0.6 m and 10 deg, {_NAMES[season]}, {name}",
                      sum(_right_in_plan(*pair) for pair in pairs), len(pairs), seed=seed,
                      at_least=1.0 if judged else None)
            )  # fmt: skip
            figures.append(
                Figure(figure=f"median error in plan, {_NAMES[season]}, {name}", value=_median(_in_plan_cm(near)),
                       unit="cm", n=len(near), seed=seed)
            )  # fmt: skip
    return figures


def _covariance(tally: _Tally, seed: int) -> Figure:
    """1 if the covariance is right, more if it promises too much."""
    squares = []
    for case, made in zip(tally.cases[NEAR], tally.made[NEAR][OURS], strict=True):
        if case.scan.season is Season.DORMANT and isinstance(made, Registration):
            off = made.T_target_source.t - case.scan.T_map_lidar.t
            squares.append(float(off @ np.linalg.solve(made.covariance[:3, :3], off)) / 3.0)
    value = float(np.mean(squares)) if squares else None
    return Figure(
        figure="squared error over the covariance's, winter", value=value, unit="ratio", n=len(squares), seed=seed
    )


def _memory(tally: _Tally, seed: int) -> Figure:
    """Ground is what the coarsest cells stand on."""
    area = sum(len(np.unique(m.grids[0].centres()[:, :2], axis=0)) * m.grids[0].size ** 2 for m in tally.maps)
    value = sum(m.nbytes for m in tally.maps) / 1e6 / (area / 1e4)
    return Figure(figure="memory of the map", value=value, unit="MB/ha", n=len(tally.maps), seed=seed)
