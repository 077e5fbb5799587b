"""The 3D map of a run: made by a process, followed, stopped, gone on with, listed, taken home, thrown away."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from fastapi.testclient import TestClient

from backend.station import Station
from navcore.maps.cloud_files.cloud_file import read_cloud
from navcore.maps.ndt.ndt_file import read_ndt_map
from navcore.messages import RunState
from tests.backend.played_robot import PlayedRobot, until
from tests.backend.starting import start
from tests.navcore.mapping.point_orchard import DriveCase, write_log

SHORT = DriveCase(length=5.0)


@pytest.fixture
def ended(robot: PlayedRobot, client: TestClient, station: Station, ready: dict[str, Any]) -> dict[str, Any]:
    """A run that has ended and left a log with clouds."""
    run_id = start(client, ready).json()["id"]
    assert until(lambda: client.get(f"/api/runs/{run_id}").json()["distance_m"] > 0.0)
    robot.state = RunState.FINISHED
    assert until(lambda: client.get(f"/api/runs/{run_id}").json()["outcome"] == "finished")
    log = station.runs.expected_log(run_id)
    log.unlink(missing_ok=True)
    write_log(log, SHORT)
    run: dict[str, Any] = client.get(f"/api/runs/{run_id}").json()
    return run


def state(client: TestClient, run_id: str) -> str | None:
    job = client.get(f"/api/runs/{run_id}/map3d").json()["job"]
    return None if job is None else job["state"]


def test_a_run_is_mapped_and_its_files_are_taken_home_and_thrown_away(
    client: TestClient, station: Station, ended: dict[str, Any], tmp_path: Path
) -> None:
    url, site_url = f"/api/runs/{ended['id']}/map3d", f"/api/sites/{ended['site_id']}/maps3d"
    before = client.get(url).json()
    assert before["clouds"] > 50
    assert (before["job"], before["map"], before["begun"]) == (None, None, False)
    assert client.get(site_url).json() == []
    assert client.post(url).status_code == 202
    assert client.post(url).status_code == 409
    assert until(lambda: state(client, ended["id"]) != "running", 500.0)
    after = client.get(url).json()
    assert after["job"]["state"] == "done", after["job"]
    assert [made["run_id"] for made in client.get(site_url).json()] == [ended["id"]]
    names = {file["name"]: file["size_bytes"] for file in after["map"]["files"]}
    assert set(names) == {"map.ndt", "cloud.laz", "cloud.pcd", "report.json"}
    for name, size in names.items():
        got = client.get(f"{site_url}/{ended['id']}/files/{name}")
        assert len(got.content) == size
        (tmp_path / name).write_bytes(got.content)
    assert len(read_ndt_map(tmp_path / "map.ndt")) > 100
    assert len(read_cloud(tmp_path / "cloud.laz").cloud) == after["map"]["points"]
    choice = f"/api/sites/{ended['site_id']}/map3d/in_use"
    assert client.get(choice).json() == {"run_id": None}
    used = client.put(choice, json={"run_id": ended["id"]})
    given = station.settings.data_dir / "robot" / f"{ended['site_id']}.ndt"
    if after["map"]["georeferenced"]:
        assert used.json() == client.get(choice).json() == {"run_id": ended["id"]}
        assert given.read_bytes() == (tmp_path / "map.ndt").read_bytes()
    else:
        assert used.status_code == 409
    assert client.put(choice, json={"run_id": "0" * 16}).status_code == 404
    assert client.delete(f"{site_url}/{ended['id']}").status_code == 204
    assert not given.exists()
    assert client.get(choice).json() == {"run_id": None}
    assert client.get(site_url).json() == []
    assert client.get(url).json()["map"] is None


def test_a_stopped_map_keeps_what_was_done(client: TestClient, ended: dict[str, Any]) -> None:
    url = f"/api/runs/{ended['id']}/map3d"
    client.post(url)
    assert until(lambda: client.get(url).json()["begun"], 300.0)
    assert client.delete(f"/api/sites/{ended['site_id']}/maps3d/{ended['id']}").status_code == 409
    assert client.delete(f"{url}/job").status_code == 204
    assert until(lambda: state(client, ended["id"]) == "failed", 60.0)
    told = client.get(url).json()
    assert told["job"]["message"] == "Stopped. What was done is kept; go on whenever you like."
    assert told["begun"]
    assert client.delete(f"{url}/job").status_code == 404


def test_a_run_without_clouds_says_so_in_words(client: TestClient, station: Station, ended: dict[str, Any]) -> None:
    log = station.runs.expected_log(ended["id"])
    log.unlink()
    write_log(log, DriveCase(length=1.0, scans=False))
    url = f"/api/runs/{ended['id']}/map3d"
    assert client.get(url).json()["clouds"] == 0
    client.post(url)
    assert until(lambda: state(client, ended["id"]) == "failed", 300.0)
    assert "has no clouds of a 3D LiDAR" in client.get(url).json()["job"]["message"]


def test_only_names_of_ours_are_handed_out(client: TestClient, ended: dict[str, Any]) -> None:
    answer = client.get(f"/api/sites/{ended['site_id']}/maps3d/{ended['id']}/files/rowpilot.sqlite3")
    assert answer.status_code == 404
    assert client.delete(f"/api/sites/{ended['site_id']}/maps3d/{'0' * 16}").status_code == 404


def test_a_farm_that_is_deleted_leaves_the_robot_no_map(
    client: TestClient, station: Station, ready: dict[str, Any]
) -> None:
    site_id = client.get("/api/sites").json()[0]["id"]
    robot = station.settings.data_dir / "robot"
    robot.mkdir(parents=True, exist_ok=True)
    given = [robot / f"{site_id}.ndt", robot / f"{site_id}.ndt.run"]
    for path in given:
        path.write_bytes(b"a map")
    assert client.delete(f"/api/sites/{site_id}").status_code == 204
    assert not any(path.exists() for path in given)
