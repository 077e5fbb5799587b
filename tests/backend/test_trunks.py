"""The trunk map of a site: grown by runs, shown with addresses, taken home, thrown away."""

from __future__ import annotations

import csv
import io
from typing import Any

import pytest
from fastapi.testclient import TestClient

from backend.shown_trunks import shown_file
from backend.station import Station
from navcore.maps.site_map import Row
from navcore.maps.trunk_map import MappedTrunk, TrunkMap
from navcore.transport.codec import decode
from tests.backend.played_robot import PlayedRobot
from tests.backend.starting import start


def beside(row: Row, run: str, count: int = 6) -> TrunkMap:
    """Trunks on the row's left line, 1.5 m apart, for a row that runs north or east."""
    (x0, y0), (x1, y1) = row.start, row.end
    north = abs(y1 - y0) > abs(x1 - x0)
    half, way = row.width / 2.0, 1.0 if (y1 - y0 if north else x1 - x0) > 0 else -1.0
    at = [way * (1.0 + 1.5 * k + 0.1 * (k % 3)) for k in range(count)]
    places = [(x0 - way * half, y0 + a) if north else (x0 + a, y0 + way * half) for a in at]
    return TrunkMap(
        trunks=tuple(
            MappedTrunk(id=f"{run}-{k}", x=x, y=y, std=0.03, diameter=0.1) for k, (x, y) in enumerate(places, start=1)
        )
    )


@pytest.fixture
def row(station: Station, ready: dict[str, Any]) -> Row:
    """The first row of the site that a mission is ready for."""
    return station.sites.get(ready["site_id"]).site.rows[0]


def test_a_map_grows_by_each_run_once(station: Station, ready: dict[str, Any], row: Row) -> None:
    site_id = ready["site_id"]
    assert station.trunk_maps.add(site_id, "a" * 16, beside(row, "a")).added == 6
    again = station.trunk_maps.add(site_id, "a" * 16, beside(row, "a"))
    assert again.message == "This run is in the trunk map already."
    second = station.trunk_maps.add(site_id, "b" * 16, beside(row, "b", count=8))
    assert (second.added, second.total) == (2, 8)
    trunk_map, runs = station.trunk_maps.get(site_id)
    assert runs == 2
    assert [t.times_seen for t in trunk_map.trunks] == [2] * 6 + [1] * 2


def test_trunks_are_shown_with_their_addresses(
    client: TestClient, station: Station, ready: dict[str, Any], row: Row
) -> None:
    path = f"/api/sites/{ready['site_id']}/trunks"
    assert client.get(path).json() == {"trunks": [], "runs": 0}
    station.trunk_maps.add(ready["site_id"], "a" * 16, beside(row, "a"))
    shown = client.get(path).json()
    assert shown["trunks"][2]["addresses"][0]["name"] == "left trunk 3 of 6"
    assert len(client.get(f"{path}/geojson").json()["features"]) == 6
    lines = list(csv.DictReader(io.StringIO(client.get(f"{path}/csv").text)))
    assert [line["number"] for line in lines] == ["1", "2", "3", "4", "5", "6"]
    assert client.delete(path).status_code == 204
    assert client.get(path).json()["trunks"] == []
    assert client.get(f"/api/sites/{'0' * 16}/trunks").status_code == 404


def test_one_press_on_a_trunk_makes_a_mission_that_stops_there(
    client: TestClient, station: Station, ready: dict[str, Any], row: Row
) -> None:
    station.trunk_maps.add(ready["site_id"], "a" * 16, beside(row, "a"))
    path = f"/api/sites/{ready['site_id']}/missions/for-row"
    mission = client.post(path, json={"row_id": row.id, "exit": "through", "stop_at": "a-3"}).json()
    assert [(v["stop_at"], v["exit"]) for v in mission["visits"]] == [("a-3", "reverse")]
    gone = client.post(path, json={"row_id": row.id, "stop_at": "gone"})
    assert gone.status_code == 404
    assert "choose a trunk" in gone.json()["message"]


@pytest.mark.usefixtures("robot")
def test_a_broken_log_is_told_and_loses_nothing(
    client: TestClient, station: Station, ready: dict[str, Any], row: Row
) -> None:
    station.trunk_maps.add(ready["site_id"], "a" * 16, beside(row, "a"))
    run_id = start(client, ready).json()["id"]
    station.runs.expected_log(run_id).write_bytes(b"no log at all")
    answer = client.post(f"/api/runs/{run_id}/trunks")
    assert answer.status_code >= 400
    assert "Choose a log" in answer.json()["message"]
    assert len(station.trunk_maps.get(ready["site_id"])[0].trunks) == 6


def test_a_run_without_a_lidar_says_so(client: TestClient, robot: PlayedRobot, ready: dict[str, Any]) -> None:
    run_id = start(client, ready).json()["id"]
    answer = client.post(f"/api/runs/{run_id}/trunks")
    assert answer.status_code == 200, answer.text
    assert answer.json()["message"] == "This run saw no trunks: it drove no row with a 2D LiDAR."


def test_a_map_taken_home_and_mended_comes_back(
    client: TestClient, station: Station, ready: dict[str, Any], row: Row
) -> None:
    path = f"/api/sites/{ready['site_id']}/trunks"
    station.trunk_maps.add(ready["site_id"], "a" * 16, beside(row, "a"))
    home = client.get(f"{path}/geojson").json()
    assert client.delete(f"{path}/a-2").status_code == 204
    assert [t["id"] for t in client.get(path).json()["trunks"]] == ["a-1", "a-3", "a-4", "a-5", "a-6"]
    assert client.delete(f"{path}/a-2").status_code == 404
    back = client.put(f"{path}/geojson", json=home)
    assert (len(back.json()["trunks"]), back.json()["runs"]) == (6, 1)
    again = station.trunk_maps.add(ready["site_id"], "a" * 16, beside(row, "a"))
    assert again.message == "This run is in the trunk map already."


def test_a_file_with_one_bad_trunk_changes_nothing(
    client: TestClient, station: Station, ready: dict[str, Any], row: Row
) -> None:
    path = f"/api/sites/{ready['site_id']}/trunks"
    station.trunk_maps.add(ready["site_id"], "a" * 16, beside(row, "a"))
    file = client.get(f"{path}/geojson").json()
    file["features"][3]["properties"]["diameter"] = "thick"
    refused = client.put(f"{path}/geojson", json=file)
    assert refused.status_code == 422
    assert "diameter" in " ".join([refused.json()["message"], *refused.json()["reasons"]])
    assert len(client.get(path).json()["trunks"]) == 6


def test_the_3d_view_is_given_each_state_of_the_map(
    client: TestClient, station: Station, ready: dict[str, Any], row: Row
) -> None:
    site_id, file = ready["site_id"], shown_file(station.settings.data_dir / "robot", ready["site_id"])
    station.trunk_maps.add(site_id, "a" * 16, beside(row, "a"))
    assert len(decode(TrunkMap, file.read_bytes()).trunks) == 6
    client.delete(f"/api/sites/{site_id}/trunks/a-1")
    assert len(decode(TrunkMap, file.read_bytes()).trunks) == 5
    client.delete(f"/api/sites/{site_id}/trunks")
    assert decode(TrunkMap, file.read_bytes()).trunks == ()
