"""An operator says where the robot stands; the navigator takes it or says why not."""

from __future__ import annotations

from typing import Any

import pytest
from fastapi.testclient import TestClient

from navcore.messages import RequestKind
from tests.backend.played_robot import PlayedRobot

URL = "/api/robot/place"


@pytest.fixture
def told(ready: dict[str, Any], client: TestClient) -> dict[str, Any]:
    """A press on the robot's farm."""
    return {"site_id": client.get("/api/robot").json()["site_id"], "x": 3.5, "y": 8.0, "yaw": 1.5}


def test_the_navigator_hears_where_the_robot_stands(
    robot: PlayedRobot, client: TestClient, told: dict[str, Any]
) -> None:
    assert client.post(URL, json=told).json() == {"accepted": True}
    request = robot.requests[-1]
    assert request.kind is RequestKind.PLACE
    assert request.place is not None
    assert (request.place.x, request.place.y, request.place.yaw) == (3.5, 8.0, 1.5)
    assert request.place.datum == (41.5, -5.4, 700.0)


def test_every_reason_of_the_navigator_reaches_the_page(
    robot: PlayedRobot, client: TestClient, told: dict[str, Any]
) -> None:
    robot.refused[RequestKind.PLACE] = ("The robot moves.", "RTK knows where it stands.")
    answer = client.post(URL, json=told)
    assert answer.status_code == 409
    assert answer.json()["reasons"] == ["The robot moves.", "RTK knows where it stands."]


def test_a_place_on_another_farm_is_refused_before_the_robot_hears_of_it(
    robot: PlayedRobot, client: TestClient, told: dict[str, Any]
) -> None:
    other = client.get(f"/api/sites/{told['site_id']}").json()["site"]
    farm = client.post("/api/sites", json={"site": {**other, "name": "Other farm"}}).json()
    answer = client.post(URL, json={**told, "site_id": farm["id"]})
    assert answer.status_code == 409
    assert "another farm" in answer.json()["reasons"][0]
    assert RequestKind.PLACE not in robot.kinds()
    assert client.post(URL, json={**told, "site_id": "0" * 16}).status_code == 404


@pytest.mark.parametrize("wrong", [{"x": 1e9}, {"yaw": "east"}, {"y": None}, {"yaw": 100.0}])
def test_what_is_no_place_is_refused(
    robot: PlayedRobot, client: TestClient, told: dict[str, Any], wrong: dict[str, Any]
) -> None:
    assert client.post(URL, json={**told, **wrong}).status_code == 422
    assert RequestKind.PLACE not in robot.kinds()


def test_who_is_not_logged_in_says_nothing(robot: PlayedRobot, visitor: TestClient) -> None:
    assert visitor.post(URL, json={"site_id": "0" * 16, "x": 0.0, "y": 0.0, "yaw": 0.0}).status_code in (401, 403)
    assert RequestKind.PLACE not in robot.kinds()
