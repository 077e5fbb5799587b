"""Sites and missions over HTTP."""

from __future__ import annotations

import json
from typing import Any

import pytest
from fastapi.testclient import TestClient
from hypothesis import HealthCheck, given
from hypothesis import settings as hypothesis_settings
from hypothesis import strategies as st

from navcore.maps.mission import Mission
from navcore.maps.site_map import SiteMap
from tests.backend.starting import as_json, paths_to_numbers, with_text_at


@pytest.fixture
def stored(client: TestClient, site: SiteMap) -> dict[str, Any]:
    answer = client.post("/api/sites", json={"site": as_json(site)})
    assert answer.status_code == 201, answer.text
    document: dict[str, Any] = answer.json()
    return document


def test_a_site_comes_back_as_it_was_stored(client: TestClient, stored: dict[str, Any], site: SiteMap) -> None:
    read = client.get(f"/api/sites/{stored['id']}").json()
    assert read == stored
    assert read["site"] == as_json(site)
    assert read["version"] == 1


def test_the_list_counts_rows_and_missions(client: TestClient, stored: dict[str, Any], mission: Mission) -> None:
    client.post(f"/api/sites/{stored['id']}/missions", json={"mission": as_json(mission)})
    (line,) = client.get("/api/sites").json()
    assert (line["rows"], line["lanes"], line["missions"]) == (2, 1, 1)


def test_a_stale_change_is_refused_and_changes_nothing(client: TestClient, stored: dict[str, Any]) -> None:
    address = f"/api/sites/{stored['id']}"
    first = client.put(address, json={"version": 1, "site": stored["site"] | {"name": "first"}})
    second = client.put(address, json={"version": 1, "site": stored["site"] | {"name": "second"}})
    assert (first.status_code, second.status_code) == (200, 409)
    assert "changed elsewhere" in second.json()["message"]
    assert client.get(address).json()["name"] == "first"
    assert client.get(address).json()["version"] == 2


def test_a_stale_mission_is_refused(client: TestClient, stored: dict[str, Any], mission: Mission) -> None:
    made = client.post(f"/api/sites/{stored['id']}/missions", json={"mission": as_json(mission)}).json()
    change = {"version": made["version"], "mission": made["mission"] | {"name": "again"}}
    assert client.put(f"/api/missions/{made['id']}", json=change).status_code == 200
    assert client.put(f"/api/missions/{made['id']}", json=change).status_code == 409


def test_a_mission_gets_the_stations_id(client: TestClient, stored: dict[str, Any], mission: Mission) -> None:
    body = {"mission": as_json(mission) | {"id": "../../etc/passwd"}}
    made = client.post(f"/api/sites/{stored['id']}/missions", json=body).json()
    assert made["mission"]["id"] == made["id"]
    assert len(made["id"]) == 16


def test_deleting_a_site_deletes_its_missions(client: TestClient, stored: dict[str, Any], mission: Mission) -> None:
    made = client.post(f"/api/sites/{stored['id']}/missions", json={"mission": as_json(mission)}).json()
    assert client.delete(f"/api/sites/{stored['id']}").status_code == 204
    assert client.get(f"/api/missions/{made['id']}").status_code == 404
    assert client.get(f"/api/sites/{stored['id']}").status_code == 404


def test_geojson_out_and_in_gives_the_same_farm(client: TestClient, stored: dict[str, Any]) -> None:
    exported = client.get(f"/api/sites/{stored['id']}/geojson").json()
    assert exported["type"] == "FeatureCollection"
    imported = client.post("/api/sites/import", json=exported).json()
    assert len(imported["site"]["rows"]) == 2
    row, again = stored["site"]["rows"][0], imported["site"]["rows"][0]
    assert again["start"] == pytest.approx(row["start"], abs=1e-3)  # m


def test_what_was_noticed_in_an_imported_farm_is_told(client: TestClient, stored: dict[str, Any]) -> None:
    exported = client.get(f"/api/sites/{stored['id']}/geojson").json()
    assert client.post("/api/sites/import", json=exported).json()["notes"] == []
    exported["features"][0]["properties"]["variety"] = "Pinot Noir"
    (note,) = client.post("/api/sites/import", json=exported).json()["notes"]
    assert "variety" in note


def test_a_mission_goes_out_and_in_as_geojson(client: TestClient, stored: dict[str, Any], mission: Mission) -> None:
    made = client.post(f"/api/sites/{stored['id']}/missions", json={"mission": as_json(mission)}).json()
    exported = client.get(f"/api/missions/{made['id']}/geojson").json()
    imported = client.post(f"/api/sites/{stored['id']}/missions/import", json=exported)
    assert imported.status_code == 201, imported.text
    assert [v["row_id"] for v in imported.json()["mission"]["visits"]] == ["r1"]


def test_one_click_on_a_row_makes_a_mission_that_can_be_previewed(client: TestClient, stored: dict[str, Any]) -> None:
    made = client.post(f"/api/sites/{stored['id']}/missions/for-row", json={"row_id": "r1", "exit": "reverse"})
    assert made.status_code == 200, made.text
    preview = client.post(f"/api/sites/{stored['id']}/preview", json={"mission": made.json()}).json()
    assert preview["problems"] == []
    assert preview["length_m"] > 2 * 60.0
    assert preview["duration_s"] > preview["length_m"] / 1.3
    assert preview["plan"]["segments"]


def test_an_impossible_mission_tells_why(client: TestClient, stored: dict[str, Any], mission: Mission) -> None:
    body = {"mission": as_json(mission) | {"visits": [{"row_id": "nowhere"}]}}
    preview = client.post(f"/api/sites/{stored['id']}/preview", json=body).json()
    assert preview["problems"]


@pytest.mark.parametrize("bad", ["NaN", "Infinity", "-Infinity", "1e999", '"nan"'])
def test_no_number_of_a_site_may_be_anything_but_finite(client: TestClient, stored: dict[str, Any], bad: str) -> None:
    document = {"version": 1, "site": stored["site"]}
    for path in paths_to_numbers(document):
        answer = client.put(
            f"/api/sites/{stored['id']}",
            content=with_text_at(document, path, bad),
            headers={"Content-Type": "application/json"},
        )
        assert answer.status_code == 422, (path, answer.text)
        assert set(answer.json()) == {"message", "reasons"}
    assert client.get(f"/api/sites/{stored['id']}").json() == stored


ADDRESSES = ("/api/sites", "/api/sites/import", "/api/runs", "/api/robot/site")


@given(st.recursive(st.none() | st.booleans() | st.floats() | st.text(max_size=20), st.lists, max_leaves=8))
@hypothesis_settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_no_body_makes_the_station_stumble(client: TestClient, value: Any) -> None:
    for address in ADDRESSES:
        for body in (json.dumps(value), json.dumps({"site": value, "type": value, "features": value})):
            answer = client.post(address, content=body, headers={"Content-Type": "application/json"})
            assert answer.status_code in (409, 413, 422), (address, body, answer.text)


@pytest.mark.parametrize("body", [b"", b"[" * 200_000, b'{"site":', b"\xff\xfe", b"1" * 60_000, b'"\\ud800"'])
def test_a_broken_body_is_refused_in_a_sentence(client: TestClient, body: bytes) -> None:
    for address in ADDRESSES[:2]:
        answer = client.post(address, content=body, headers={"Content-Type": "application/json"})
        assert answer.status_code in (400, 422)
        assert answer.json()["message"].endswith(".")


def test_half_a_character_is_refused_wherever_it_stands(client: TestClient, stored: dict[str, Any]) -> None:
    farm = f"/api/sites/{stored['id']}"
    mission = '{"mission":{"id":"","name":"\\ud800","outbound":[],"visits":[],"inbound":[]}}'
    for address, body in (
        ("/api/sites/import", '{"type":"FeatureCollection","features":[],"name":"\\ud800"}'),
        ("/api/sites", json.dumps({"site": stored["site"] | {"name": "\ud800"}})),
        (f"{farm}/missions", mission),
        (f"{farm}/preview", mission),
        (f"{farm}/missions/for-row", '{"row_id":"\\ud800"}'),
    ):
        answer = client.post(address, content=body, headers={"Content-Type": "application/json"})
        assert answer.status_code == 422, address
        assert "broken" in answer.text, address


def test_a_body_beyond_the_limit_is_refused(client: TestClient) -> None:
    answer = client.post("/api/robot/site", json={"site_id": "x" * 70_000})
    assert answer.status_code == 413
    streamed = client.post(
        "/api/robot/site",
        content=(b" " * 10_000 for _ in range(10)),
        headers={"Content-Type": "application/json"},
    )
    assert streamed.status_code == 413
