"""A start during a run is refused, and the run and its log go on as if nobody had asked."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import pytest
from fastapi.testclient import TestClient

from backend.station import Station
from navcore.messages import RequestKind, RunState
from tests.backend.played_robot import PlayedRobot, until
from tests.backend.starting import start

pytestmark = pytest.mark.usefixtures("robot")


def messages_logged(client: TestClient, run_id: str) -> int:
    """Size of the log while it is being written."""
    recorder = client.get("/api/live/latest").json()["recorder/status"]
    recorded = recorder and recorder["recording"] and recorder["run_id"] == run_id
    return int(recorder["size_bytes"]) if recorded else 0


def is_recorded_on(client: TestClient, run_id: str) -> bool:
    before = messages_logged(client, run_id)
    return until(lambda: messages_logged(client, run_id) > before)


@pytest.mark.parametrize(
    ("state", "reason"),
    [
        (RunState.DRIVING, "under way"),
        (RunState.HOLDING, "under way"),
        (RunState.PAUSED, "under way"),
        (RunState.STOPPED, "resume the mission"),
    ],
)
def test_a_second_start_is_refused_and_the_first_run_is_recorded_on(
    client: TestClient, robot: PlayedRobot, ready: dict[str, Any], state: RunState, reason: str
) -> None:
    run_id = start(client, ready).json()["id"]
    robot.state = state
    assert until(lambda: client.get("/api/robot").json()["state"] == state)
    answer = start(client, ready)
    assert answer.status_code == 409
    assert reason in " ".join(answer.json()["reasons"])
    assert is_recorded_on(client, run_id)
    assert [run["id"] for run in client.get("/api/runs").json()] == [run_id]
    assert robot.kinds().count(RequestKind.START) == 1


def test_of_two_starts_at_once_one_drives_and_is_recorded(
    client: TestClient, robot: PlayedRobot, ready: dict[str, Any]
) -> None:
    with ThreadPoolExecutor(4) as pages:
        answers = list(pages.map(lambda _: start(client, ready), range(4)))
    assert sorted(answer.status_code for answer in answers) == [201, 409, 409, 409]
    run_id = next(answer.json()["id"] for answer in answers if answer.status_code == 201)
    assert robot.kinds().count(RequestKind.START) == 1
    assert is_recorded_on(client, run_id)


def test_what_a_running_mission_was_made_of_may_be_deleted(
    client: TestClient, robot: PlayedRobot, ready: dict[str, Any], station: Station
) -> None:
    run_id = start(client, ready).json()["id"]
    assert client.delete(f"/api/missions/{ready['id']}").status_code == 204
    assert client.delete(f"/api/sites/{ready['site_id']}").status_code == 204
    assert is_recorded_on(client, run_id)
    assert robot.state is RunState.DRIVING
    assert client.get(f"/api/runs/{run_id}").json()["mission"]["visits"] == ready["mission"]["visits"]
