"""One season in one block: drives that localize on its map, and robots that are switched on there."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.bench.lidar3d.fixed_point_figures import DRIVE_SEED
from navcore.bench.lidar3d.localization_drive import Placed, localized
from navcore.bench.lidar3d.restart_figures import Restarts, restarts
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.sim.block_drive import BlockDriveParams
from navcore.sim.orchard import Season
from navcore.sim.pear_block import PearBlock


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SeasonCase:
    """Drives through `rows` and robots switched on, so many of each, on the block's `ndt_map`."""

    block: PearBlock
    season: Season
    ndt_map: NdtMap
    rows: tuple[int, ...]
    drives: int
    restarts: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SeasonDrives:
    """What came of a `SeasonCase`: the turns of each drive, and each robot that was switched on."""

    season: Season
    drives: list[list[Placed]]
    restarts: list[Restarts]


def drive_season(case: SeasonCase) -> SeasonDrives:
    """One after the other."""
    params = [BlockDriveParams(seed=DRIVE_SEED + k, season=case.season, rows=case.rows) for k in range(case.drives)]
    return SeasonDrives(
        season=case.season, drives=[list(localized(case.block, p, case.ndt_map)) for p in params],
        restarts=restarts(case.block, case.season, case.ndt_map, case.restarts, lambda _: None),
    )  # fmt: skip
