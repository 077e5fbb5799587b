"""Healthy drives on a map, watched for moments in which the robot takes its trust from a right place.

Nothing is put wrong and nothing is broken. The robot judges the map with what it has on these drives: wheels, gyro
and RTK; the rows that a camera sees are no witness here.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from navcore.bench.lidar3d.localization_drive import matched_turns
from navcore.geometry.se2 import SE2
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.messages import MapMatch, MatchState
from navcore.sim.block_drive import BlockDriveParams
from navcore.sim.orchard import Season
from navcore.sim.pear_block import PearBlock

RIGHT_M = 0.3
WATCH_SEED = 50_001


@dataclass(frozen=True, slots=True, kw_only=True)
class WatchParams:
    """How long is watched.

    Attributes:
        laps: (m/s, times through all rows and back) of the drives in each season of each block; those with an odd
            number begin with the last row. 3.3 h in two blocks of 72 m and three seasons.
    """

    laps: tuple[tuple[float, int], ...] = ((0.5, 2), (1.0, 3), (1.5, 6))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class WatchedCase:
    """One drive on the block's `ndt_map`."""

    block: PearBlock
    drive: BlockDriveParams
    ndt_map: NdtMap


@dataclass(frozen=True, slots=True, kw_only=True)
class Watched:
    """What came of a `WatchedCase`.

    Attributes:
        alarms: why the map lost its trust, each time that its place was right. deserved: times that it was wrong.
        turns: of the LiDAR. believed: of them, those whose place was used.
    """

    season: Season
    hours: float
    alarms: tuple[str, ...]
    deserved: int
    turns: int
    believed: int


def watched_cases(
    block: PearBlock, number: int, ndt_map: NdtMap, rows: tuple[int, ...], params: WatchParams
) -> list[WatchedCase]:  # fmt: skip
    """All seasons of the `number`th block; no two drives have the same seed."""
    seeds = iter(range(WATCH_SEED + 100 * number, WATCH_SEED + 100 * (number + 1)))
    drives = (
        BlockDriveParams(seed=next(seeds), season=season, speed=speed, rows=rows[:: -1 if k % 2 else 1] * laps)
        for season in (Season.DORMANT, Season.BUDDING, Season.GROWING)
        for k, (speed, laps) in enumerate(params.laps)
    )
    return [WatchedCase(block=block, drive=drive, ndt_map=ndt_map) for drive in drives]


def watch(case: WatchedCase) -> Watched:
    """Drive it."""
    stamps, alarms, believed = [], [], 0
    for stamp_ns, used, alarm in _turns(case):
        stamps.append(stamp_ns)
        believed += used
        alarms += [alarm] if alarm is not None else []
    false = tuple(reason for reason, right in alarms if right)
    return Watched(
        season=case.drive.season, hours=(stamps[-1] - stamps[0]) / 3.6e12, alarms=false,
        deserved=len(alarms) - len(false), turns=len(stamps), believed=believed,
    )  # fmt: skip


def _turns(case: WatchedCase) -> Iterator[tuple[int, bool, tuple[str, bool] | None]]:
    """Of each turn its stamp, ns, whether its place was used, and of a new alarm why, and whether it is false."""
    disputed = False
    for turn, match, senses in matched_turns(case.block, case.drive, case.ndt_map):
        on_map, before = senses.on_map, disputed
        disputed = on_map.disputed
        alarm = (on_map.reason, _is_right(match, turn.T_map_base.se2())) if disputed and not before else None
        yield turn.stamp_ns, on_map.newest is match, alarm


def _is_right(match: MapMatch, truth: SE2) -> bool:
    away = math.hypot(match.x - truth.x, match.y - truth.y)
    return match.state is MatchState.MATCHED and away <= RIGHT_M
