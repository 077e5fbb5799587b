"""Calibrations that are kept: chosen again, rehearsed, damaged or of another robot."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from fastapi.testclient import TestClient

from backend.calibrator.process import kept_in
from backend.settings import Settings
from navcore.calibration.calibration_file import CalibrationVersion
from navcore.calibration.session.state import SessionSetup
from navcore.calibration.version_folder import VersionFolder
from navcore.messages import CalibrationJob, CameraName, RunState
from tests.backend.played_robot import PlayedRobot, until
from tests.navcore.calibration.boards import BOARD, CAMERA, LENS

PATH = "/api/calibration"
VERSION = CalibrationVersion(
    id="v1", made_utc="2026-03-01T10:15:00Z", made_by="Ana", robot="ant", camera="7", intrinsics=CAMERA, lens=LENS,
    camera_std={"fx": 0.3}, rms_px=0.05, left_out_px=0.06, pictures=20,
)  # fmt: skip


@pytest.fixture
def settings(tmp_path: Path, bus_dir: Path) -> Settings:
    return Settings(data_dir=tmp_path / "data", bus_dir=bus_dir, keep_free_bytes=0, robot="ant", scene=False)


def test_what_is_found_in_a_rehearsal_never_comes_where_the_robot_looks() -> None:
    setup = SessionSetup(
        id="s", job=CalibrationJob.CAMERA, camera=CameraName.FRONT, board=BOARD, robot="ant", began_utc=""
    )  # fmt: skip
    robot, rehearsals = Path("calibration"), Path("rehearsal")
    assert kept_in(setup, robot, rehearsals) == robot
    assert kept_in(replace(setup, rehearsal=True), robot, rehearsals) == rehearsals


def test_a_calibration_is_refused_while_a_mission_is_under_way(
    robot: PlayedRobot, client: TestClient, settings: Settings
) -> None:  # fmt: skip
    VersionFolder(settings.calibration_dir, "ant").add(CameraName.FRONT, VERSION)
    assert until(lambda: client.get("/api/robot").json()["connected"])
    robot.state = RunState.DRIVING
    assert until(lambda: client.get("/api/robot").json()["state"] == "driving")
    begun = client.post(PATH, json={"job": "camera"})
    chosen = client.put(f"{PATH}/versions", json={"camera": "front", "id": None})
    accepted = client.post(f"{PATH}/accept", json={"made_by": "Ada", "camera": "left"})
    assert [answer.status_code for answer in (begun, chosen, accepted)] == [409] * 3
    assert begun.json()["message"] == "A mission is under way. Stop it before you calibrate."


def test_an_older_version_is_put_in_use_again_and_the_robot_told(
    robot: PlayedRobot, client: TestClient, settings: Settings
) -> None:
    folder = VersionFolder(settings.calibration_dir, "ant")
    older, newer = folder.add(CameraName.FRONT, VERSION), folder.add(CameraName.FRONT, VERSION)
    folder.use(CameraName.FRONT, newer.id)

    def in_use() -> list[str]:
        return [v["id"] for v in client.get(f"{PATH}/versions").json() if v["in_use"]]

    assert in_use() == [newer.id]
    assert client.put(f"{PATH}/versions", json={"camera": "front", "id": older.id}).status_code == 200
    assert in_use() == [older.id]
    assert robot.calibrations_loaded == 1
    assert client.put(f"{PATH}/versions", json={"camera": "front", "id": None}).status_code == 200
    assert in_use() == []
    assert robot.calibrations_loaded == 2


def test_another_rehearsal_does_not_close_the_robots_eyes(
    robot: PlayedRobot, client: TestClient, settings: Settings
) -> None:
    rehearsed = VersionFolder(settings.rehearsal_dir, "ant").add(CameraName.FRONT, VERSION)
    chosen = client.put(f"{PATH}/versions", json={"camera": "front", "id": rehearsed.id, "rehearsal": True})
    assert chosen.status_code == 200
    assert robot.calibrations_loaded == 0


def test_a_robot_that_does_not_answer_takes_the_calibration_later(
    monkeypatch: pytest.MonkeyPatch, client: TestClient, settings: Settings
) -> None:
    monkeypatch.setattr("backend.supervisor.LOAD_MS", 200)
    added = VersionFolder(settings.calibration_dir, "ant").add(CameraName.FRONT, VERSION)
    assert client.put(f"{PATH}/versions", json={"camera": "front", "id": added.id}).status_code == 200
    assert VersionFolder(settings.calibration_dir, "ant").in_use(CameraName.FRONT) == added.id


def test_a_damaged_version_and_another_robots_are_shown_and_cannot_be_used(
    client: TestClient, settings: Settings
) -> None:  # fmt: skip
    theirs = VersionFolder(settings.calibration_dir, "bee").add(CameraName.FRONT, replace(VERSION, robot="bee"))
    broken = settings.calibration_dir / "front" / "broken.json"
    broken.write_text('{"id": "broken"')
    told = {v["id"]: v["problem"] for v in client.get(f"{PATH}/versions").json()}
    assert "of robot bee, not of ant" in told[theirs.id]
    assert "damaged" in told["broken"]
    for version_id in (theirs.id, "broken", "nothing"):
        refused = client.put(f"{PATH}/versions", json={"camera": "front", "id": version_id})
        assert refused.status_code == 422
        assert refused.json()["message"].endswith(".")
