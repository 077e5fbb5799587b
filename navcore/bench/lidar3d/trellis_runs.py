"""Runs of the simulated 3D LiDAR through a pear block, season by season, with the true posts and wires."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se3 import SE3
from navcore.mapping.trellis.seen_cloud import SeenCloud
from navcore.maps.site_map import PlantKind
from navcore.sim.lidar3d import C16, Lidar3d
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, PearBlock
from navcore.sim.rays.land_scene import Part
from navcore.sim.trellis.trellised import Trellised, TrellisParams

Floats = NDArray[np.float64]

# Paper C: LiDAR 0.2 m ahead of the middle of a Scout 2.0 and 0.25 m above its deck.
MOUNT = LidarMount(x=0.2, y=0.0, z=0.6)
_BEYOND_M = 5.0


@dataclass(frozen=True, slots=True, kw_only=True)
class TrellisRunParams:
    """How a run is made.

    Attributes:
        size: of the block. columns: of a turn of the LiDAR. every: distance driven between two turns, m.
        pose_std: 1-sigma of the mapped poses, each way, m, and yaw_std, rad: what a map's poses are off by. Of it
            `shared` is the share that all turns of a run have in common.
        reach: points further from the block's middle than its half diagonal and this are left out, m.
    """

    size: BlockSize
    columns: int = 900
    every: float = 0.5
    pose_std: float = 0.01
    yaw_std: float = math.radians(0.05)
    shared: float = 0.5
    reach: float = 12.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class TrellisRun:
    """What a run saw, and the truth.

    Attributes:
        standing, gone: (P, 2) places of posts, m. trunks: (T, 2). wires: (W, 3) middles of short pieces of wire.
    """

    season: Season
    cloud: SeenCloud
    standing: Floats
    gone: Floats
    trunks: Floats
    wires: Floats


def trellis_run(block: PearBlock, season: Season, params: TrellisRunParams, *, posts_gone: float = 0.0) -> TrellisRun:
    """Down one alley and back through the next, placed by poses that are a little off."""
    trellised = block.trellised(season, TrellisParams(posts_gone=posts_gone))
    posts = trellised.posts
    return TrellisRun(
        season=season, cloud=_cloud(block, season, trellised, params), standing=posts.feet[posts.standing, :2],
        gone=posts.feet[~posts.standing, :2],
        trunks=np.array([(p.x, p.y) for p in block.site.plants if p.kind is PlantKind.TRUNK]),
        wires=_wires(trellised),
    )  # fmt: skip


def _cloud(block: PearBlock, season: Season, trellised: Trellised, params: TrellisRunParams) -> SeenCloud:
    rng = np.random.default_rng((block.seed, list(Season).index(season)))
    lidar = Lidar3d(trellised.scene, MOUNT, replace(C16, columns=params.columns), seed=block.seed)
    T_base_lidar = SE3(MOUNT.R_base_lidar(), np.array((MOUNT.x, MOUNT.y, MOUNT.z)))
    common = rng.normal(0.0, params.pose_std * math.sqrt(params.shared), 3)
    points, origins = [], []
    for number, T_map_base in enumerate(_drive(block, params.every), start=1):
        turn = lidar.turn(number * 10**9, [number * 10**9 - 2 * 10**8, number * 10**9], [T_map_base] * 2)
        T = _mapped(T_map_base, common, rng, params) @ T_base_lidar
        points.append(T.apply(turn.cloud.points))
        origins.append(np.tile(T.t, (len(turn.cloud), 1)))
    return _near(block, np.concatenate(points), np.concatenate(origins), season, params)


def _wires(trellised: Trellised) -> Floats:
    scene = trellised.scene
    pieces = scene.shapes[scene.parts == Part.WIRE]
    return np.asarray((pieces[:, :3] + pieces[:, 3:6]) / 2)


def _near(block: PearBlock, points: Floats, origins: Floats, season: Season, params: TrellisRunParams) -> SeenCloud:
    ends = np.array([end for row in block.site.rows for end in (row.start, row.end)])
    middle = ends.mean(axis=0)
    reach = float(np.linalg.norm(ends - middle, axis=1).max()) + params.reach
    kept = np.linalg.norm(points[:, :2] - middle, axis=1) <= reach
    return SeenCloud(points=points[kept], origins=origins[kept], name=season.value)


def _mapped(T: SE3, common: Floats, rng: np.random.Generator, params: TrellisRunParams) -> SE3:
    """The pose as a map has it."""
    own = rng.normal(0.0, params.pose_std * math.sqrt(1.0 - params.shared), 3)
    turned = SE3.from_rpy((0.0, 0.0, 0.0), yaw=float(rng.normal(0.0, params.yaw_std)))
    return SE3(turned.R @ T.R, T.t + common + own)


def _drive(block: PearBlock, every: float) -> list[SE3]:
    """Level poses down the alleys, every other one backwards, on the uneven ground."""
    land, poses = block.ground(), []
    for k, row in enumerate(block.site.rows):
        start, end = np.array(row.start), np.array(row.end)
        begin, unit, length = start, (end - start) / math.dist(row.start, row.end), math.dist(row.start, row.end)
        if k % 2:
            begin, unit = end, -unit
        for way in np.arange(-_BEYOND_M, length + _BEYOND_M, every):
            x, y = (begin + way * unit).tolist()
            poses.append(SE3.from_rpy((x, y, land.height(x, y)), yaw=math.atan2(unit[1], unit[0])))
    return poses
