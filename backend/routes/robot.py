"""The robot itself: is it there, what is it, on which farm does the simulated one stand."""

from __future__ import annotations

from fastapi import APIRouter

from backend.deps import ERRORS, TheLogin, TheStation
from backend.schemas import Robot, RobotSite

router = APIRouter(prefix="/api/robot", tags=["robot"], responses=ERRORS)


@router.get("")
def read_robot(station: TheStation) -> Robot:
    """What the station knows of the robot."""
    return station.robot.describe()


@router.post("/site")
def place_robot(station: TheStation, login: TheLogin, body: RobotSite) -> Robot:
    """Put the simulated robot on a farm; the simulator starts again there."""
    station.robot.place(body.site_id, station.sites.get(body.site_id).site)
    station.audit.write(login, "place", body.site_id, "done")
    return station.robot.describe()
