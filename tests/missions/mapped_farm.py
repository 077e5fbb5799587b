"""A small farm's 3D map, and the LiDAR of a robot on it."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from navcore.geometry.lidar_mount import robot_lidar3d
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.messages import SimTruth
from navcore.sim.body_pose import body_pose
from navcore.sim.lidar3d import C16, Lidar3d
from navcore.sim.lidar3d_feed import Lidar3dFeed
from navcore.sim.map_error import NO_MAP_ERROR
from navcore.sim.trellis.trellised import trellised
from navcore.sim.world import World, WorldParams
from navcore.vehicle import PAPER_A

STEP_M = 2.0
TURN_NS = 100_000_000
AS_DRAWN = WorldParams(seed=4, map_error=NO_MAP_ERROR)


MOUNT = robot_lidar3d()
# Half as many rays as the sensor has: the places come out as well, in half the time.
LIDAR = replace(C16, columns=900)


def lidar_of(world: World, seed: int) -> Lidar3dFeed:
    """Turns of a 3D LiDAR in that world."""
    scene = trellised(world.site, world.orchard, world.terrain).scene
    return Lidar3dFeed(scene, world.terrain, PAPER_A, MOUNT, LIDAR, seed)


def mapped(world: World) -> NdtMap:
    """The farm's map, from clouds taken at known places along its roads and rows."""
    ndt_map, site = NdtMap(datum=world.site.datum), world.site
    lidar = Lidar3d(trellised(site, world.orchard, world.terrain).scene, MOUNT, LIDAR, 9)
    ways = [(row.start, row.end) for row in site.rows] + [(lane.points[0], lane.points[-1]) for lane in site.lanes]
    stamp_ns = 0
    for (x0, y0), (x1, y1) in ways:
        yaw, length = math.atan2(y1 - y0, x1 - x0), math.dist((x0, y0), (x1, y1))
        for share in np.arange(0.0, 1.0, STEP_M / length):
            stamp_ns += TURN_NS
            x, y = x0 + share * (x1 - x0), y0 + share * (y1 - y0)
            truth = SimTruth(stamp_ns=stamp_ns, x=x, y=y, yaw=yaw, roll=0.0, pitch=0.0, v=0.0, omega=0.0)
            T_map_base = body_pose(truth, world.terrain, PAPER_A)
            turn = lidar.turn(stamp_ns, (stamp_ns - TURN_NS, stamp_ns), (T_map_base, T_map_base))
            ndt_map.add((T_map_base @ MOUNT.T_base_lidar()).apply(turn.cloud.points))
    return ndt_map
