"""Scans of a simulated pear block with their true places, and the map that a drive in winter makes of it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.maps.site_map import Row
from navcore.sim.lidar3d import C16, Lidar3d
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, PearBlock, scoring_block, tuning_block
from navcore.sim.terrain import Terrain

Floats = NDArray[np.float64]

SEASONS = (Season.DORMANT, Season.BUDDING, Season.MATURING)
# On top of the robot, over its middle.
MOUNT = LidarMount(x=0.0, y=0.0, z=1.2)
_FINE_M = 0.1
_SECOND_NS = 1_000_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class NdtScanParams:
    """What is mapped and scanned.

    Attributes:
        block: number of the block; tuning: one that parameters may be tuned on, else one for scores alone.
        size: of the block. step: between two scans that are mapped, m.
        scans: of each season, to register.
        lateral, turned: off the alley's middle, m, and off its direction, rad, drawn evenly to either side.
    """

    block: int = 1
    tuning: bool = False
    size: BlockSize = BlockSize(alleys=6, length=72.0)
    step: float = 2.0
    scans: int = 40
    lateral: float = 0.8
    turned: float = 0.3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PlacedScan:
    """One turn of a robot at rest: points (N, 3) in the sensor's frame, m, and where it truly was."""

    points: Floats
    T_map_lidar: SE3
    season: Season


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class NdtScans:
    """A map, the same points for others (M, 3), one in 10 cm, and scans to lay onto it."""

    ndt_map: NdtMap
    points: Floats
    scans: tuple[PlacedScan, ...]


def ndt_scans(params: NdtScanParams) -> NdtScans:
    """Deterministic by the block's number."""
    block = (tuning_block if params.tuning else scoring_block)(params.block, params.size)
    mapped, cloud = NdtMap(datum=block.site.datum), np.empty((0, 3))
    for season in SEASONS:
        eye = _Eye(block, season)
        if season is Season.DORMANT:
            mapped, cloud = _mapped(eye, params)
            scans: list[PlacedScan] = []
        scans += [_placed(eye, params, k) for k in range(params.scans)]
    return NdtScans(ndt_map=mapped, points=cloud, scans=tuple(scans))


class _Eye:
    """A robot that stands still in a block."""

    def __init__(self, block: PearBlock, season: Season) -> None:
        self.block, self.season = block, season
        self._ground: Terrain = block.ground()
        self._lidar = Lidar3d(block.trellised(season).scene, MOUNT, C16, block.seed)

    def look(self, number: int, row: Row, along: float, lateral: float, yaw: float) -> PlacedScan:
        """Turn `number`; `along` from the row's start, `lateral` to its left, m, `yaw` off its direction, rad."""
        way = math.atan2(row.end[1] - row.start[1], row.end[0] - row.start[0])
        x = row.start[0] + along * math.cos(way) - lateral * math.sin(way)
        y = row.start[1] + along * math.sin(way) + lateral * math.cos(way)
        T_map_base = self._on_ground(x, y, way + yaw)
        stamp = (number + 1) * _SECOND_NS
        turn = self._lidar.turn(stamp, (stamp - _SECOND_NS, stamp), (T_map_base, T_map_base))
        T_base_lidar = SE3.from_rpy((MOUNT.x, MOUNT.y, MOUNT.z), MOUNT.roll, MOUNT.pitch, MOUNT.yaw)
        return PlacedScan(points=turn.cloud.points, T_map_lidar=T_map_base @ T_base_lidar, season=self.season)

    def _on_ground(self, x: float, y: float, yaw: float) -> SE3:
        """As steep as the ground is over a robot's length and width."""
        c, s, half = math.cos(yaw), math.sin(yaw), 0.35
        height = self._ground.height
        rise = (height(x + half * c, y + half * s) - height(x - half * c, y - half * s)) / (2.0 * half)
        bank = (height(x - half * s, y + half * c) - height(x + half * s, y - half * c)) / (2.0 * half)
        return SE3.from_rpy((x, y, height(x, y)), math.atan(bank), -math.atan(rise), yaw)


def _mapped(eye: _Eye, p: NdtScanParams) -> tuple[NdtMap, Floats]:
    """Along every alley, down the one and up the next."""
    ndt_map, cloud, number = NdtMap(datum=eye.block.site.datum), np.empty((0, 3)), 10_000
    for k, row in enumerate(eye.block.site.rows):
        for along in np.arange(0.0, p.size.length + 1e-9, p.step):
            scan = eye.look(number, row, float(along), 0.0, math.pi * (k % 2))
            points, number = scan.T_map_lidar.apply(scan.points), number + 1
            ndt_map.add(points)
            cloud = voxel_means(np.vstack((cloud, points)), _FINE_M)
    return ndt_map, cloud


def _placed(eye: _Eye, p: NdtScanParams, number: int) -> PlacedScan:
    rng = np.random.default_rng((eye.block.seed, 73, number))
    rows = eye.block.site.rows
    lateral, along = rng.uniform(-p.lateral, p.lateral), rng.uniform(0.0, p.size.length)
    yaw = math.pi * rng.integers(0, 2) + rng.uniform(-p.turned, p.turned)
    return eye.look(number, rows[rng.integers(0, len(rows))], float(along), float(lateral), float(yaw))
