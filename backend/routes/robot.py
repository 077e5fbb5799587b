"""The robot itself: is it there, what is it, on which farm does the simulated one stand."""

from __future__ import annotations

from fastapi import APIRouter

from backend.deps import ERRORS, TheLogin, TheStation
from backend.schemas import ActionResult, Robot, RobotPlace, RobotSite

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


@router.post("/place")
def say_where_it_stands(station: TheStation, login: TheLogin, body: RobotPlace) -> ActionResult:
    """Where the 3D map is to look for the standing robot; 409 with every reason if that may not be said now."""
    station.placer.place(login, body)
    return ActionResult(accepted=True)
