"""A small farm's 3D map, and the LiDAR of a robot on it."""

from __future__ import annotations

from dataclasses import replace

from navcore.bench.lidar3d.known_map import known_map
from navcore.geometry.lidar_mount import robot_lidar3d
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.sim.lidar3d import C16
from navcore.sim.lidar3d_feed import Lidar3dFeed
from navcore.sim.map_error import NO_MAP_ERROR
from navcore.sim.trellis.trellised import trellised
from navcore.sim.world import World, WorldParams
from navcore.vehicle import PAPER_A

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
    return known_map(world, PAPER_A, MOUNT, LIDAR)
