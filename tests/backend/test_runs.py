"""Runs: started once, stopped always, looked back at; the robot is played, everything else is real."""

from __future__ import annotations

import json
import time
from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from backend.station import Station
from navcore.messages import RequestKind, RunState
from tests.backend.played_robot import JPEG, PlayedRobot, until
from tests.backend.starting import as_json, start

pytestmark = pytest.mark.usefixtures("robot")


def test_a_mission_is_started_and_the_run_keeps_its_own_copies(
    client: TestClient, robot: PlayedRobot, ready: dict[str, Any]
) -> None:
    answer = start(client, ready)
    assert answer.status_code == 201, answer.text
    run = answer.json()
    (request,) = (r for r in robot.requests if r.kind is RequestKind.START)
    assert request.plan is not None
    assert (request.run_id, request.link_loss) == (run["id"], "stop")
    changed = {"version": 1, "mission": ready["mission"] | {"name": "changed while driving", "visits": []}}
    assert client.put(f"/api/missions/{ready['id']}", json=changed).status_code == 200
    assert client.delete(f"/api/sites/{ready['site_id']}").status_code == 204
    detail = client.get(f"/api/runs/{run['id']}").json()
    assert detail["mission"]["visits"] == ready["mission"]["visits"]
    assert detail["plan"] == as_json(request.plan)
    assert detail["site_id"] is None


def test_a_start_is_good_once(client: TestClient, robot: PlayedRobot, ready: dict[str, Any]) -> None:
    body = {
        "mission_id": ready["id"],
        "link_loss": "continue",
        "nonce": client.get("/api/drive/nonce").json()["nonce"],
    }
    assert client.post("/api/runs", json=body).status_code == 201
    again = client.post("/api/runs", json=body)
    assert again.status_code == 409
    assert client.post("/api/runs", json=body | {"nonce": "made up"}).status_code == 409
    assert robot.kinds().count(RequestKind.START) == 1


def test_a_refused_start_tells_every_reason_and_leaves_nothing(
    client: TestClient, robot: PlayedRobot, ready: dict[str, Any], station: Station
) -> None:
    robot.refusals = ("The emergency stop is pressed.", "The battery is empty.")
    answer = start(client, ready)
    assert answer.status_code == 409
    assert answer.json()["reasons"] == list(robot.refusals)
    assert client.get("/api/runs").json() == []
    assert list(station.settings.run_dir.glob("*.mcap")) == []
    assert RequestKind.STOP not in robot.kinds()


def test_all_reasons_come_at_once(client: TestClient, robot: PlayedRobot, ready: dict[str, Any]) -> None:
    robot.site_id = "f" * 16
    broken = {"version": 1, "mission": ready["mission"] | {"visits": [{"row_id": "gone"}]}}
    client.put(f"/api/missions/{ready['id']}", json=broken)
    reasons: list[str] = []

    def told() -> bool:  # the farm is asked for once a second
        reasons[:] = start(client, ready).json()["reasons"]
        return any("another farm" in reason for reason in reasons)

    assert until(told)
    assert len(reasons) >= 2
    assert RequestKind.START not in robot.kinds()


@pytest.mark.parametrize("state", list(RunState))
def test_stop_reaches_guard_and_navigator_in_every_state(
    client: TestClient, robot: PlayedRobot, state: RunState
) -> None:
    robot.state = state
    for times in (1, 2):
        answer = client.post("/api/runs/current/stop")
        assert answer.status_code == 200
        assert answer.json()["guard"] is True
        assert robot.stops == times
    assert until(lambda: robot.kinds().count(RequestKind.STOP) >= 1)


def test_pause_resume_and_acknowledge_reach_the_navigator(
    client: TestClient, robot: PlayedRobot, ready: dict[str, Any]
) -> None:
    start(client, ready)
    for action, state in (("pause", RunState.PAUSED), ("resume", RunState.DRIVING)):
        assert client.post(f"/api/runs/current/{action}").json() == {"accepted": True}
        assert robot.state is state
    assert client.post("/api/runs/current/dance").status_code == 422


@pytest.fixture
def driven(client: TestClient, robot: PlayedRobot, ready: dict[str, Any]) -> dict[str, Any]:
    """A finished run, some way long, with pictures."""
    robot.camera = True
    address = f"/api/runs/{start(client, ready).json()['id']}"
    assert until(lambda: client.get(address).json()["distance_m"] > 0.5)
    robot.state = RunState.FINISHED
    assert until(lambda: client.get(address).json()["outcome"] == "finished")
    run: dict[str, Any] = client.get(address).json()
    return run


def test_a_run_is_summed_up(driven: dict[str, Any]) -> None:
    assert driven["mean_lateral_error"] == pytest.approx(0.03, abs=1e-6)  # m
    assert driven["ended"] is not None
    assert [e["text"] for e in driven["events"] if e["kind"] == "state"][-1] == "finished"
    assert driven["log_bytes"] > 0


def test_a_run_has_a_track_and_the_pictures_along_it(client: TestClient, driven: dict[str, Any]) -> None:
    address = f"/api/runs/{driven['id']}"
    track = client.get(f"{address}/track")
    assert track.status_code == 200, track.text
    columns = track.json()
    assert len({len(columns[name]) for name in ("t_s", "x", "mode", "lateral_error")}) == 1
    assert columns["x"][-1] > 0.5
    picture = client.get(f"{address}/camera", params={"t_s": columns["camera_t_s"][3] + 0.01})
    assert (picture.status_code, picture.content) == (200, JPEG)
    assert json.loads(picture.headers["x-camera-view"])["row"]["reason"] == "too dark"
    assert client.get(f"{address}/camera", params={"t_s": 3600.0}).status_code == 404


def test_a_run_is_downloaded_in_four_forms_and_no_other(client: TestClient, driven: dict[str, Any]) -> None:
    address = f"/api/runs/{driven['id']}/download"
    for form, beginning in (("mcap", b"\x89MCAP0\r\n"), ("csv", b"t_s,"), ("geojson", b"{"), ("gpx", b"<?xml")):
        answer = client.get(address, params={"format": form})
        assert answer.status_code == 200, answer.text
        assert answer.content.startswith(beginning)
        assert f"run-{driven['id']}.{form}" in answer.headers["content-disposition"]
    assert client.get(address, params={"format": "exe"}).status_code == 422


def test_a_part_of_a_log_is_given_and_thousands_of_parts_are_no_bomb(
    client: TestClient, driven: dict[str, Any]
) -> None:
    address = f"/api/runs/{driven['id']}/download"
    part = client.get(address, headers={"Range": "bytes=0-7"})
    assert (part.status_code, part.content) == (206, b"\x89MCAP0\r\n")
    bomb = client.get(address, headers={"Range": "bytes=" + ",".join(["0-1"] * 5000)})
    assert bomb.status_code in (200, 206, 400, 416)
    assert len(bomb.content) < 10 * driven["log_bytes"] + 1_000_000


def test_a_log_that_leads_out_of_its_folder_is_not_given(
    client: TestClient, driven: dict[str, Any], station: Station, tmp_path: Path
) -> None:
    secret = tmp_path / "secret"
    secret.write_text("not for browsers")
    log = station.runs.expected_log(driven["id"])
    log.unlink()
    log.symlink_to(secret)
    for kind in ("download", "download?format=csv", "track", "camera?t_s=1"):
        answer = client.get(f"/api/runs/{driven['id']}/{kind}")
        assert (answer.status_code, "not for browsers" in answer.text) == (404, False)


def test_a_stopped_run_keeps_why_it_was_stopped(
    client: TestClient, robot: PlayedRobot, ready: dict[str, Any]
) -> None:
    run_id = start(client, ready).json()["id"]

    def run() -> Any:
        return client.get(f"/api/runs/{run_id}").json()

    assert until(lambda: run()["outcome"] == "running")
    robot.stop_reason = "The bumper was touched."
    robot.state = RunState.STOPPED
    assert until(lambda: run()["outcome"] == "stopped")
    assert run()["reason"] == robot.stop_reason
    robot.stop_reason = ""
    robot.state = RunState.IDLE
    assert until(lambda: run()["state"] == "idle")
    assert run()["reason"] == "The bumper was touched."
    assert client.get("/api/runs").json()[0]["reason"] == "The bumper was touched."
    robot.state = RunState.DRIVING
    assert until(lambda: run()["outcome"] == "running")
    assert run()["reason"] == ""


def test_a_mission_cannot_start_without_a_robot(
    client: TestClient, robot: PlayedRobot, ready: dict[str, Any]
) -> None:
    robot.close()
    assert until(lambda: not client.get("/api/robot").json()["connected"])
    answer = start(client, ready)
    assert answer.status_code == 409
    assert any("not connected" in reason for reason in answer.json()["reasons"])
    stop = client.post("/api/runs/current/stop").json()
    assert stop["guard"] is False
    assert "emergency stop" in stop["message"]


def test_a_robot_that_was_placed_anew_is_not_ready_before_it_says_so_itself(
    client: TestClient, robot: PlayedRobot, ready: dict[str, Any]
) -> None:
    def status() -> Any:
        return client.get("/api/live/latest").json()["nav/status"]

    def nothing_comes() -> bool:
        before = status()
        time.sleep(0.1)
        return bool(status() == before)

    robot.silent = True
    assert until(nothing_comes)
    assert client.post("/api/robot/site", json={"site_id": ready["site_id"]}).status_code == 200
    assert client.get("/api/robot").json()["connected"] is False


def test_the_log_of_a_stopped_run_is_closed_by_its_acknowledgement(
    client: TestClient, robot: PlayedRobot, ready: dict[str, Any]
) -> None:
    def is_recording() -> bool:
        recorder = client.get("/api/live/latest").json()["recorder/status"]
        return bool(recorder and recorder["recording"])

    run_id = start(client, ready).json()["id"]
    assert until(lambda: client.get(f"/api/runs/{run_id}").json()["outcome"] == "running")
    client.post("/api/runs/current/stop")
    assert until(lambda: client.get(f"/api/runs/{run_id}").json()["outcome"] == "stopped")
    assert until(is_recording)
    assert client.post("/api/runs/current/acknowledge").json() == {"accepted": True}
    assert until(lambda: not is_recording())
