"""Rows from a 3D map: proposed, not taken, until somebody accepts them; bad files become a sentence."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from fastapi.testclient import TestClient

from backend.station import Station
from navcore.geometry.point_cloud import PointCloud
from navcore.maps.cloud_files.pcd import pcd_bytes
from navcore.maps.site_map import SiteMap
from navcore.maps.vector_map.osm_data import read_osm
from tests.backend.played_robot import until
from tests.backend.starting import as_json
from tests.navcore.mapping.standing_block import StandingBlock

BLOCK = StandingBlock(lines=3, posts=4)


def sent(client: TestClient, site_id: str, data: bytes, name: str) -> dict[str, Any]:
    """The job at its end."""
    answer = client.post(f"/api/sites/{site_id}/found-rows", params={"name": name}, content=data)
    assert answer.status_code == 202, answer.text
    path = f"/api/jobs/{answer.json()['job_id']}"
    assert until(lambda: client.get(path).json()["state"] != "running", 300.0)
    job: dict[str, Any] = client.get(path).json()
    return job


@pytest.fixture
def empty_site(client: TestClient, site: SiteMap) -> str:
    """A farm with a warehouse and one row that has the id of a found one."""
    farm = replace(site, rows=(replace(site.rows[0], id="row-1"),), lanes=())
    created: str = client.post("/api/sites", json={"site": as_json(farm)}).json()["id"]
    return created


def test_rows_of_a_map_are_proposed_and_the_site_stays_until_they_are_accepted(
    client: TestClient, station: Station, empty_site: str
) -> None:
    before = client.get(f"/api/sites/{empty_site}").json()
    job = sent(client, empty_site, pcd_bytes(PointCloud.of(BLOCK.seen(rays=False).points)), "block.pcd")
    assert job["state"] == "done", job
    found = client.get(f"/api/sites/{empty_site}/found-rows").json()
    assert len(found["rows"]) == 2
    assert {row["id"] for row in found["rows"]} == {"row-1-2", "row-2"}
    assert [zone["kind"] for zone in found["zones"]] == ["headland", "headland"]
    assert any("2 rows" in note for note in found["notes"])
    assert client.get(f"/api/sites/{empty_site}").json() == before
    assert list(station.settings.upload_dir.iterdir()) == []
    assert client.delete(f"/api/sites/{empty_site}/found-rows").status_code == 204
    assert client.get(f"/api/sites/{empty_site}/found-rows").json() is None


def test_a_cut_off_map_becomes_a_sentence(client: TestClient, station: Station, empty_site: str) -> None:
    data = pcd_bytes(PointCloud.of(BLOCK.seen(rays=False).points))
    job = sent(client, empty_site, data[: len(data) // 2], "block.pcd")
    assert job["state"] == "failed"
    assert "block.pcd" in job["message"] or "cut off" in job["message"]
    assert client.get(f"/api/sites/{empty_site}/found-rows").json() is None
    assert list(station.settings.upload_dir.iterdir()) == []


def test_what_is_no_3d_map_is_refused_before_it_is_sent(client: TestClient, empty_site: str) -> None:
    for name in ("photo.tif", "scan.bin", "map", "map.pcd.exe"):
        answer = client.post(f"/api/sites/{empty_site}/found-rows", params={"name": name}, content=b"x")
        assert answer.status_code == 422
        assert ".laz" in answer.json()["message"]
    unknown = client.post("/api/sites/0123456789abcdef/found-rows", params={"name": "a.pcd"}, content=b"x")
    assert unknown.status_code == 404


def test_a_site_goes_out_as_lanelet2_and_comes_in_again(client: TestClient, site: SiteMap) -> None:
    first = client.post("/api/sites", json={"site": as_json(site)}).json()
    answer = client.get(f"/api/sites/{first['id']}/osm")
    assert answer.headers["content-type"].startswith("application/xml")
    assert len(read_osm(answer.content).relations) >= 3
    again = client.post("/api/sites/import/osm", content=answer.content)
    assert again.status_code == 201, again.text
    assert again.json()["site"] == first["site"]


def test_broken_lanelets_make_no_site_and_say_why(client: TestClient) -> None:
    bomb = b'<?xml version="1.0"?><!DOCTYPE l [<!ENTITY a "ha"><!ENTITY b "&a;&a;">]><osm><tag k="&b;" v=""/></osm>'
    for data in (b"", b"{}", b"<osm>", bomb, b'<osm version="0.6"></osm>'):
        answer = client.post("/api/sites/import/osm", content=data)
        assert answer.status_code == 422, data
        assert answer.json()["message"].endswith(".")
    assert client.get("/api/sites").json() == []
