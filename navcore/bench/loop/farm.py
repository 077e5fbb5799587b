"""The farm that `rowpilot bench loop` drives on, and its 3D map."""

from __future__ import annotations

import math
from dataclasses import replace

from navcore.bench.lidar3d.known_map import known_map
from navcore.config import RobotConfig
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.maps.site_map import SiteMap, Warehouse
from navcore.runtime.simulation import SimulationParams
from navcore.sim.demo_farm import demo_farm


def near_the_rows() -> SiteMap:
    """The demo farm with the robot parked where its road meets the rows: the camera is used within seconds."""
    farm = demo_farm()
    (x0, y0), (x1, y1) = farm.lanes[0].points[-2:]
    return replace(farm, name="Bench", warehouse=Warehouse(x=x0, y=y0, yaw=math.atan2(y1 - y0, x1 - x0)))


def map_of(site: SiteMap, simulation: SimulationParams) -> NdtMap:
    """The map of what truly stands in the simulated world of a robot with the settings as they are."""
    vehicle = RobotConfig().vehicle_params()
    return known_map(simulation.world(site, vehicle, 0), vehicle, RobotConfig().lidar3d.mount)
