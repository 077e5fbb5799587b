"""From the press on the page to a mission on the 3D map: station, navigator, localizer, without a single GNSS fix."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from navcore.localization.lidar3d.map_localizer import MapLocalizer
from navcore.runtime.lockstep import Lockstep
from navcore.runtime.simulated_eye import ProjectedEye
from navcore.runtime.simulated_map_eye import SimulatedMapEye
from navcore.sim.world import World
from navcore.vehicle import PAPER_A
from tests.backend.lockstep_robot import LockstepRobot
from tests.backend.played_robot import until
from tests.backend.starting import as_json, start
from tests.missions.conftest import CONFIG, small_farm
from tests.missions.mapped_farm import AS_DRAWN, MOUNT, lidar_of, mapped

FARM = small_farm()
PATIENCE_S = 120.0  # of a busy machine, on which ten simulated seconds may take a minute


@pytest.fixture
def robot(bus_dir: Path) -> Iterator[LockstepRobot]:
    """With a 3D LiDAR on its farm's map, and a receiver that says nothing."""
    world = World(FARM, PAPER_A, AS_DRAWN, start_ns=1_000_000_000)
    world.faults = replace(world.faults, gnss_silent=True)
    lockstep = Lockstep(
        world, CONFIG.new_navigator(FARM.datum), ProjectedEye(world.orchard, AS_DRAWN.seed),
        map_eye=SimulatedMapEye(lidar_of(world, 11), MOUNT, MapLocalizer(mapped(World(FARM, PAPER_A, AS_DRAWN)))),
    )  # fmt: skip
    lost = LockstepRobot(bus_dir, lockstep)
    yield lost
    lost.close()


def newest(client: TestClient) -> dict[str, Any]:
    """What the page is shown of the robot."""
    status: dict[str, Any] = client.get("/api/live/latest").json()["nav/status"] or {}
    return status


def asks(client: TestClient) -> bool:
    return any(event["name"] == "place_unknown" for event in newest(client).get("events", ()))


def test_a_press_on_the_map_leads_to_a_mission_on_it(robot: LockstepRobot, client: TestClient) -> None:
    farm = client.post("/api/sites", json={"site": as_json(FARM)}).json()
    made = client.post(f"/api/sites/{farm['id']}/missions/for-row", json={"row_id": "r1", "exit": "reverse"}).json()
    mission = client.post(f"/api/sites/{farm['id']}/missions", json={"mission": made}).json()
    client.post("/api/robot/site", json={"site_id": farm["id"]})
    assert until(lambda: asks(client), PATIENCE_S)
    refused = start(client, mission)
    assert refused.status_code == 409
    assert any("not known yet" in reason for reason in refused.json()["reasons"])

    truth = robot.truth
    assert truth is not None
    press = {"site_id": farm["id"], "x": truth.x - 0.8, "y": truth.y + 1.0, "yaw": truth.yaw - 0.4}
    assert client.post("/api/robot/place", json=press).json() == {"accepted": True}
    assert until(lambda: newest(client).get("pose") is not None, PATIENCE_S)
    pose = newest(client)["pose"]
    assert math.dist((pose["x"], pose["y"]), (truth.x, truth.y)) < 0.1  # m
    assert until(lambda: not asks(client), PATIENCE_S)

    assert start(client, mission).status_code == 201
    assert until(lambda: newest(client)["mode"] == "map" and newest(client)["state"] == "driving", PATIENCE_S)
    assert newest(client)["gnss_age_s"] is None
    late = client.post("/api/robot/place", json=press)
    assert late.status_code == 409
    assert "A mission is under way" in late.json()["reasons"][0]
