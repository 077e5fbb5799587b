"""Where the robot's body and what is mounted on it truly are: on the uneven ground, leaning and shaking."""

from __future__ import annotations

import math

from navcore.geometry.pinhole import rotation_from_rpy
from navcore.geometry.se3 import SE3
from navcore.messages import SimTruth
from navcore.sim.gnss_receiver import AntennaState
from navcore.sim.terrain import Terrain
from navcore.sim.vehicle_dynamics import VehicleDynamics
from navcore.vehicle import VehicleParams


def antenna_state(
    drive: VehicleDynamics, roll: float, pitch: float, vehicle: VehicleParams, ground: float, off: tuple[float, float]
) -> AntennaState:
    """The main antenna of a body at `roll` and `pitch`, rad; `off` m east and north of where it is."""
    lever = rotation_from_rpy(roll, pitch, drive.yaw) @ (vehicle.antenna_x, vehicle.antenna_y, vehicle.antenna_height)
    c, s = math.cos(drive.yaw), math.sin(drive.yaw)
    vx = drive.v * c - drive.lateral_v * s - drive.omega * float(lever[1])
    vy = drive.v * s + drive.lateral_v * c + drive.omega * float(lever[0])
    return AntennaState(
        x=drive.x + float(lever[0]) + off[0], y=drive.y + float(lever[1]) + off[1], z=float(lever[2]), vx=vx, vy=vy,
        yaw=drive.yaw, ground=ground,
    )  # fmt: skip


def body_pose(truth: SimTruth, terrain: Terrain, vehicle: VehicleParams) -> SE3:
    """`T_map_base` of the true robot with its wheels on the ground: z up against gravity, the land's slope included.

    `SimTruth` tells roll and pitch against the land; a 3D LiDAR sees the land itself.
    """
    land_roll, land_pitch = terrain.land_tilt(truth.yaw)
    z = terrain.rest(truth.x, truth.y, truth.yaw, vehicle.wheelbase, vehicle.track)
    return SE3.from_rpy((truth.x, truth.y, z), truth.roll + land_roll, truth.pitch + land_pitch, truth.yaw)
