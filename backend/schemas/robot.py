"""The robot, and the farm it is set up for."""

from __future__ import annotations

import math

from pydantic import Field

from backend.schemas.base import Id, Received, Sent
from navcore.messages import RunState
from navcore.vehicle import VehicleParams


class Robot(Sent):
    """What the station knows of the robot.

    Attributes:
        connected: the navigator was heard of within the last second.
        simulated: the robot is the simulator.
        site_id: the farm that the robot is set up for, None before the first or without a supervisor.
        state, run_id: from the navigator's newest status; None before the first.
        scene: the 3D view answers at `/scene/` now.
        operators: browsers with a live heartbeat.
    """

    connected: bool
    simulated: bool
    vehicle: VehicleParams
    site_id: Id | None
    state: RunState | None
    run_id: str | None
    scene: bool
    operators: int


class RobotSite(Received):
    """Sets the robot up for a farm; the simulated one is put there."""

    site_id: Id


class RobotPlace(Received):
    """Says where the standing robot is, where only its 3D map can tell: a press on the map and a turned arrow.

    Attributes:
        site_id: the farm whose map was pressed.
        x, y: `base_link` in that farm's `map` frame, m. yaw: where it looks, rad from east against the clock.
    """

    site_id: Id
    x: float = Field(ge=-1e5, le=1e5)
    y: float = Field(ge=-1e5, le=1e5)
    yaw: float = Field(ge=-2.0 * math.pi, le=2.0 * math.pi)
