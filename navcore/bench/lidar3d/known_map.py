"""A 3D map without a drive: turns of the LiDAR cast at known places along a farm's rows and roads."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from navcore.geometry.lidar_mount import LidarMount
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.maps.site_map import SiteMap
from navcore.messages import SimTruth
from navcore.sim.body_pose import body_pose
from navcore.sim.lidar3d import C16, Lidar3d, Lidar3dParams
from navcore.sim.trellis.trellised import trellised
from navcore.sim.world import World
from navcore.vehicle import VehicleParams

STEP_M = 2.0
_TURN_NS, _SEED = 100_000_000, 9


def known_map(world: World, vehicle: VehicleParams, mount: LidarMount, lidar: Lidar3dParams = C16) -> NdtMap:
    """Of what truly stands in that world, one turn every 2 m."""
    ndt_map = NdtMap(datum=world.site.datum)
    caster = Lidar3d(trellised(world.site, world.orchard, world.terrain).scene, mount, lidar, _SEED)
    for number, (x, y, yaw) in enumerate(_places(world.site)):
        stamp_ns = (number + 1) * _TURN_NS
        truth = SimTruth(stamp_ns=stamp_ns, x=x, y=y, yaw=yaw, roll=0.0, pitch=0.0, v=0.0, omega=0.0)
        T_map_base = body_pose(truth, world.terrain, vehicle)
        turn = caster.turn(stamp_ns, (stamp_ns - _TURN_NS, stamp_ns), (T_map_base, T_map_base))
        ndt_map.add((T_map_base @ mount.T_base_lidar()).apply(turn.cloud.points))
    return ndt_map


def _places(site: SiteMap) -> Iterator[tuple[float, float, float]]:
    """x, y, yaw along every row and every leg of a road."""
    legs = [(row.start, row.end) for row in site.rows]
    legs += [leg for lane in site.lanes for leg in zip(lane.points, lane.points[1:], strict=False)]
    for (x0, y0), (x1, y1) in legs:
        length = math.dist((x0, y0), (x1, y1))
        for share in np.arange(0.0, 1.0, STEP_M / length).tolist() if length else ():
            yield x0 + share * (x1 - x0), y0 + share * (y1 - y0), math.atan2(y1 - y0, x1 - x0)
