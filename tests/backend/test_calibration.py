"""A camera is calibrated through the station: begun, watched, broken off in the middle, accepted, put in use."""

from __future__ import annotations

import os
import signal
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from fastapi.testclient import TestClient

from backend.main import create_app
from backend.settings import Settings
from backend.station import Station
from navcore.calibration.session.session_folder import SessionFolder
from navcore.calibration.version_folder import VersionFolder
from navcore.messages import CameraName, RawPicture
from navcore.sim.board_pictures import BoardPictureParams, BoardPictures
from navcore.sim.board_poses import BoardPoseParams, BoardPoses
from navcore.topics import CAMERA_RAW
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher
from tests.backend.conftest import ORIGIN
from tests.backend.played_robot import PlayedRobot, until
from tests.navcore.calibration.boards import BOARD, CAMERA, LENS

PATH = "/api/calibration"
START_S = 120.0


@pytest.fixture
def settings(tmp_path: Path, bus_dir: Path) -> Settings:
    return Settings(data_dir=tmp_path / "data", bus_dir=bus_dir, keep_free_bytes=0, robot="ant", scene=False)


class HeldBoard:
    """A row worker that shows rendered pictures of a board."""

    def __init__(self, endpoints: Endpoints) -> None:
        rng = np.random.default_rng(3)
        held = BoardPoseParams(nearest=0.2, furthest=0.32, tilt_deg=40.0)
        poses, camera = (
            BoardPoses(CAMERA, LENS, BOARD, held),
            BoardPictures(CAMERA, LENS, BOARD, BoardPictureParams()),
        )
        self._pictures = [camera.render(poses.draw(rng), rng) for _ in range(12)]
        self._publisher = Publisher(endpoints, "row_worker")

    def hold(self, number: int, *, until_true: Callable[[], bool], problem: str = "") -> None:
        """Show that pose until something is so."""
        _, jpeg = cv2.imencode(".jpg", self._pictures[number % 12], (cv2.IMWRITE_JPEG_QUALITY, 90))
        deadline = time.monotonic() + START_S
        while not until_true():
            assert time.monotonic() < deadline, f"pose {number} was held in vain"
            picture = RawPicture(
                stamp_ns=time.monotonic_ns(), camera=CameraName.FRONT, width_px=640, height_px=360, problem=problem
            )  # fmt: skip
            self._publisher.publish(CAMERA_RAW.name, picture, jpeg.tobytes())

    def close(self) -> None:
        self._publisher.close()


@pytest.fixture
def held(robot: PlayedRobot, client: TestClient) -> Iterator[HeldBoard]:
    board = HeldBoard(robot.endpoints)
    yield board
    board.close()
    client.delete(PATH)


def state(client: TestClient) -> dict[str, Any]:
    """Of the calibration; empty while its process starts."""
    document: dict[str, Any] = client.get(PATH).json()
    return document["state"] or {}


def taken(client: TestClient, count: int) -> Callable[[], bool]:
    return lambda: len(state(client).get("poses", ())) >= count


def worker_pid(station: Station) -> int:
    child = station.calibrator._keeper._child
    assert child is not None
    return child.pid


def test_a_camera_is_calibrated_though_its_process_is_killed_in_the_middle(
    robot: PlayedRobot, client: TestClient, station: Station, held: HeldBoard, settings: Settings,
    monkeypatch: pytest.MonkeyPatch,
) -> None:  # fmt: skip
    assert client.get(PATH).json() == {"setup": None, "state": None, "message": ""}
    assert client.post(PATH, json={"job": "camera"}).status_code == 201
    for number in range(4):
        held.hold(number, until_true=taken(client, number + 1))

    os.kill(worker_pid(station), signal.SIGKILL)
    with monkeypatch.context() as patch:
        patch.setattr("backend.calibrator.client.ASK_MS", 200)  # ms: its successor may be there in time for more
        assert until(lambda: "Every picture that was taken is kept" in client.get(PATH).json()["message"], 30.0)
    assert until(taken(client, 4), START_S)
    assert state(client)["resumed"] == 4

    for number in range(4, 10):
        held.hold(number, until_true=taken(client, number + 1))
    assert client.get(f"{PATH}/pictures/001").content.startswith(b"\xff\xd8")

    assert state(client)["fitting"]  # the last pose is not in the result yet: nobody need press twice for that
    answer = client.post(f"{PATH}/accept", json={"made_by": " Ada ", "camera": "left"})
    assert answer.status_code == 200, answer.text
    assert client.get(PATH).json()["setup"] is None
    kept = client.get(f"{PATH}/versions").json()
    assert [(v["id"], v["in_use"], v["rehearsal"]) for v in kept] == [(answer.json()["version_id"], True, False)]
    version = VersionFolder(settings.calibration_dir, "ant").load_in_use(CameraName.FRONT)
    assert version is not None
    assert version.intrinsics.fx == pytest.approx(CAMERA.fx, rel=0.01)
    assert robot.calibrations_loaded == 1
    assert (version.made_by, version.robot, version.camera, version.pictures) == ("Ada", "ant", "left", 10)


def test_a_picture_is_thrown_out_and_brought_back(client: TestClient, held: HeldBoard) -> None:
    client.post(PATH, json={"job": "camera"})
    held.hold(0, until_true=taken(client, 1))
    out = client.put(f"{PATH}/pictures/001", json={"kept": False})
    assert out.status_code == 200, out.text
    assert [pose["kept"] for pose in out.json()["state"]["poses"]] == [False]
    back = client.put(f"{PATH}/pictures/001", json={"kept": True}).json()
    assert [pose["kept"] for pose in back["state"]["poses"]] == [True]
    gone = client.put(f"{PATH}/pictures/099", json={"kept": False})
    assert gone.status_code == 409
    assert "There is no picture" in gone.json()["reasons"][0]
    assert client.get(f"{PATH}/pictures/099").status_code == 404


def test_what_the_camera_lacks_is_told_and_nothing_can_be_accepted(client: TestClient, held: HeldBoard) -> None:
    def shown() -> dict[str, Any]:
        view: dict[str, Any] = client.get("/api/live/latest").json()["calibration/view"] or {}
        return view

    client.post(PATH, json={"job": "camera", "board": {"columns": 7, "rows": 6}})
    assert until(lambda: bool(state(client)), START_S)
    held.hold(
        0, until_true=lambda: "A board of 8 x 5 inner corners is seen, not of 7 x 6" in shown().get("words", "")
    )
    assert until(lambda: "gives no pictures" in shown().get("words", ""), 30.0)
    refused = client.post(f"{PATH}/accept", json={"made_by": "Ada", "camera": "left"})
    assert refused.status_code == 409
    assert any("8 are needed" in reason for reason in refused.json()["reasons"])


def test_a_process_that_works_on_an_older_calibration_is_not_believed(
    client: TestClient, station: Station, settings: Settings
) -> None:  # fmt: skip
    """As when a page asks once more while its calibration is thrown away and another one begins."""
    client.post(PATH, json={"job": "camera"})
    assert until(lambda: bool(state(client)), START_S)
    old = worker_pid(station)
    folder = SessionFolder(settings.calibration_session_dir)
    before = folder.setup()
    assert before is not None
    folder.throw_away()
    folder.begin(replace(before, id="another one", camera=CameraName.REAR))

    def told() -> bool:
        document = client.get(PATH).json()
        assert document["setup"]["id"] == "another one"
        assert document["state"] is None or document["state"]["setup"]["id"] == "another one"
        return document["state"] is not None

    assert until(told, START_S)
    assert worker_pid(station) != old
    client.delete(PATH)


def test_only_one_calibration_is_under_way(client: TestClient) -> None:
    assert client.post(PATH, json={"job": "camera"}).status_code == 201
    second = client.post(PATH, json={"job": "camera", "camera": "rear"})
    assert second.status_code == 409
    assert second.json()["message"] == "A calibration is under way. Accept it or throw it away first."
    assert client.delete(PATH).status_code == 204
    assert client.get(PATH).json()["setup"] is None
    assert client.post(f"{PATH}/take").status_code == 404


def test_a_lidar_needs_a_calibrated_camera_first(client: TestClient) -> None:
    refused = client.post(PATH, json={"job": "lidar"})
    assert refused.status_code == 409
    assert refused.json()["reasons"] == ["Calibrate the camera first: its lens tells where the board is."]
    assert client.get(PATH).json()["setup"] is None


def test_only_a_simulated_robot_rehearses(settings: Settings) -> None:
    real = settings.model_copy(update={"simulated": False})
    with TestClient(create_app(real), base_url=ORIGIN) as client:
        station: Station = client.app.state.station  # type: ignore[attr-defined]
        client.get("/enter", params={"token": station.logins.invite()}, follow_redirects=False)
        client.headers.update({"Origin": ORIGIN, "X-Rowpilot": "1"})
        refused = client.post(PATH, json={"job": "camera", "rehearsal": True})
    assert refused.status_code == 409
    assert "Only a simulated robot rehearses" in refused.json()["reasons"][0]


def test_the_board_to_print_is_an_svg(client: TestClient) -> None:
    answer = client.get(f"{PATH}/board", params={"columns": 8, "rows": 5, "square_mm": 27})
    assert answer.headers["content-type"].startswith("image/svg+xml")
    assert 'width="317mm"' in answer.text
    impossible = client.get(f"{PATH}/board", params={"columns": 20, "rows": 20, "charuco": True})
    assert impossible.status_code == 422
    assert "take fewer squares" in impossible.json()["message"]
