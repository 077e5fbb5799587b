"""Station or robot begin anew while a run is under way: its book is kept, or closed with a sentence."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from fastapi.testclient import TestClient

from backend.main import create_app
from backend.settings import Settings
from navcore.messages import RequestKind, RunState
from tests.backend.conftest import ORIGIN
from tests.backend.played_robot import PlayedRobot, until
from tests.backend.starting import start

pytestmark = pytest.mark.usefixtures("robot")


@contextmanager
def another_station(settings: Settings, old: TestClient) -> Iterator[TestClient]:
    """A station on the same data after the first one's end, called by the same browser."""
    with TestClient(create_app(settings), base_url=ORIGIN, raise_server_exceptions=False) as client:
        client.cookies.update(old.cookies)
        yield client


@pytest.fixture
def driving(client: TestClient, robot: PlayedRobot, ready: dict[str, Any]) -> str:
    """Address of a run that has driven some way."""
    address = f"/api/runs/{start(client, ready).json()['id']}"
    assert until(lambda: client.get(address).json()["distance_m"] > 0.3)
    return address


def recording(client: TestClient) -> bool:
    recorder = client.get("/api/live/latest").json()["recorder/status"]
    return bool(recorder and recorder["recording"])


def forget(robot: PlayedRobot) -> None:
    """As a navigator that was started again."""
    robot.state, robot.run_id = RunState.IDLE, None


def test_a_run_that_the_robot_forgot_is_closed_with_its_log(
    client: TestClient, robot: PlayedRobot, driving: str
) -> None:
    forget(robot)
    assert until(lambda: client.get(driving).json()["outcome"] == "interrupted")
    run = client.get(driving).json()
    assert "started again" in run["reason"]
    assert run["ended"] is not None
    assert run["distance_m"] > 0.3
    assert until(lambda: not recording(client))


def test_a_stopped_run_that_is_acknowledged_stays_stopped(
    client: TestClient, robot: PlayedRobot, driving: str
) -> None:
    robot.state = RunState.STOPPED
    assert until(lambda: client.get(driving).json()["outcome"] == "stopped")
    forget(robot)
    assert until(lambda: not recording(client))
    assert client.get(driving).json()["outcome"] == "stopped"


def test_a_restarted_station_goes_on_with_the_book_of_the_run(
    client: TestClient, robot: PlayedRobot, driving: str, settings: Settings
) -> None:
    client.__exit__()
    before = len(robot.requests)
    with another_station(settings, client) as again:
        told = again.get(driving).json()
        assert until(lambda: again.get(driving).json()["distance_m"] > told["distance_m"] + 0.2)
        assert again.get(driving).json()["outcome"] == "running"
        assert {request.kind for request in robot.requests[before:]} <= {RequestKind.HEARTBEAT}
        robot.state = RunState.FINISHED
        assert until(lambda: again.get(driving).json()["outcome"] == "finished")
        assert until(lambda: not recording(again))


def test_a_restarted_station_closes_the_book_of_a_run_that_nobody_drives(
    client: TestClient, robot: PlayedRobot, driving: str, settings: Settings
) -> None:
    client.__exit__()
    forget(robot)
    with another_station(settings, client) as again:
        assert until(lambda: again.get(driving).json()["outcome"] == "interrupted")
