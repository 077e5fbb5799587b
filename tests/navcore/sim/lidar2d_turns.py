"""Turns of a simulated LiDAR before a wall or a lone tree."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import robot_lidar
from navcore.maps.site_map import Datum, Plant, PlantKind, SiteMap, Warehouse
from navcore.messages import LidarScan, SimTruth
from navcore.sim.lidar2d import WORKING, Lidar2d, Lidar2dFaults, Lidar2dParams, SimScan
from navcore.sim.orchard import Orchard, OrchardParams, Season, Trellis
from navcore.sim.planting import build_orchard

Floats = NDArray[np.float64]
DATUM = Datum(lat_deg=41.0, lon_deg=-5.0, height_m=700.0)
STEP_NS = 5_000_000
REAL = Lidar2dParams()
WALL_X = -2.5
ROUNDED_M = 8e-5
"""A scan is told to 0.1 mm and 0.01 mrad: half of each, at up to 4 m, along and across a ray."""


def still(k: int) -> SimTruth:
    """Parked at (0, 0) in step `k` of 5 ms."""
    return at(k)


def at(k: int, x: float = 0.0, y: float = 0.0, yaw: float = 0.0, roll: float = 0.0, pitch: float = 0.0) -> SimTruth:
    """There in step `k` of 5 ms."""
    return SimTruth(stamp_ns=k * STEP_NS, x=x, y=y, yaw=yaw, roll=roll, pitch=pitch, v=0.0, omega=0.0)


def lone_tree(x: float, y: float) -> Orchard:
    """A bare tree at (x, y), m."""
    site = SiteMap(name="tree", datum=DATUM, plants=(Plant(x=x, y=y, kind=PlantKind.TRUNK),))
    return build_orchard(site, OrchardParams(season=Season.DORMANT, trellis=Trellis.TREES))


def shed_behind() -> Orchard:
    """A wall 12 m long across the x axis, its near face at x = WALL_X, behind a robot parked at (0, 0)."""
    site = SiteMap(name="shed", datum=DATUM, warehouse=Warehouse(x=0.0, y=0.0, yaw=0.0))
    return build_orchard(site, OrchardParams())


def turns(
    orchard: Orchard, params: Lidar2dParams, count: int = 1, *, seed: int = 1, drive: object = still,
    faults: Lidar2dFaults = WORKING,
) -> list[SimScan]:  # fmt: skip
    """The first `count` turns of a robot that moves as `drive` says for each step of 5 ms."""
    lidar = Lidar2d(orchard, robot_lidar(), params, np.random.default_rng(seed))
    for k in range(20 * count + 1):
        lidar.update(drive(k), faults)  # type: ignore[operator]
    return list(lidar.due(10**15))


def ends(scan: LidarScan) -> Floats:
    """Where rays that came back end, (N, 3) in `base_link`."""
    a, d = np.array(scan.angles), np.array(scan.distances)
    return robot_lidar().ends(a[d > 0.0], d[d > 0.0])
