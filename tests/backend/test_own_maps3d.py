"""The farm's own 3D maps: drawn from above where they lie, and looked through for rows; nothing is sent."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from fastapi.testclient import TestClient
from numpy.typing import NDArray
from pyproj import Transformer

from backend.station import Station
from navcore.geometry.geodesy import EnuFrame
from navcore.maps.mission import Mission
from navcore.maps.site_map import Datum, Lane, SiteMap
from navcore.maps.vector_map.osm_data import read_osm
from tests.backend.made_maps import BLOCK, cut, make_run, write_made_map
from tests.backend.played_robot import until
from tests.backend.starting import as_json
from tests.navcore.mapping.standing_block import POST_HEIGHT

RUN = "00000000000000aa"


@pytest.fixture
def site_id(client: TestClient, station: Station, site: SiteMap, mission: Mission) -> str:
    """A farm with nothing drawn but its warehouse, and a run on it."""
    created: str = client.post("/api/sites", json={"site": as_json(replace(site, rows=(), lanes=()))}).json()["id"]
    make_run(station, created, site, mission, RUN)
    return created


def made(station: Station, site_id: str, datum: Datum | None) -> Path:
    """The folder of a map of the run."""
    folder = station.maps3d.folder(site_id, RUN)
    write_made_map(folder, datum)
    return folder


def picture(client: TestClient, site_id: str) -> tuple[dict[str, Any], NDArray[np.uint8]]:
    """Facts and pixels (rows, columns, 4), blue first."""
    url = f"/api/sites/{site_id}/maps3d/{RUN}/picture"
    facts = client.get(url)
    assert facts.status_code == 200, facts.text
    png = client.get(f"{url}.png")
    assert png.headers["content-type"] == "image/png"
    pixels = cv2.imdecode(np.frombuffer(png.content, np.uint8), cv2.IMREAD_UNCHANGED)
    return facts.json(), np.asarray(pixels, np.uint8)


def test_posts_stand_in_the_picture_where_they_stand_on_the_earth_and_ground_is_half_see_through(
    client: TestClient, station: Station, site: SiteMap, site_id: str
) -> None:
    made(station, site_id, site.datum)
    facts, pixels = picture(client, site_id)
    assert pixels.shape == (facts["height_px"], facts["width_px"], 4)
    west, south, east, north = facts["bounds_3857"]
    high = _colour(facts, POST_HEIGHT)
    for x, y in BLOCK.post_places():
        lat, lon, _ = EnuFrame(site.datum).to_geodetic(x, y, 0.0)
        e, n = Transformer.from_crs("EPSG:4326", "EPSG:3857", always_xy=True).transform(lon, lat)
        column = int((e - west) / (east - west) * facts["width_px"])
        row = int((north - n) / (north - south) * facts["height_px"])
        near = pixels[row - 1 : row + 2, column - 1 : column + 2].reshape(-1, 4).astype(int)
        assert np.abs(near[:, 2::-1] - high).sum(axis=1).min() < 60  # of 765, within 0.3 m of the post's height
        assert near[:, 3].max() > 200
    assert set(np.unique(pixels[..., 3])) == {0, 90, 235}  # not seen, ground that lets the orthophoto through, things


def _colour(facts: dict[str, Any], height: float) -> NDArray[np.int64]:
    """Red, green, blue that the legend gives a height, m."""
    nearest = min(facts["legend"], key=lambda step: abs(step["height"] - height))["colour"]
    return np.array([int(nearest[k : k + 2], 16) for k in (1, 3, 5)])


def test_a_map_is_drawn_once_and_again_when_it_was_made_anew(
    client: TestClient, station: Station, site: SiteMap, site_id: str
) -> None:
    folder = made(station, site_id, site.datum)
    picture(client, site_id)
    drawn_ns = (folder / "above.png").stat().st_mtime_ns
    picture(client, site_id)
    assert (folder / "above.png").stat().st_mtime_ns == drawn_ns
    (folder / "report.json").write_bytes((folder / "report.json").read_bytes())
    picture(client, site_id)
    assert (folder / "above.png").stat().st_mtime_ns > drawn_ns
    assert client.delete(f"/api/sites/{site_id}/maps3d/{RUN}").status_code == 204
    assert client.get(f"/api/sites/{site_id}/maps3d/{RUN}/picture.png").status_code == 404


def test_a_map_without_a_place_on_the_earth_says_so_and_is_not_used(
    client: TestClient, station: Station, site_id: str
) -> None:
    folder = made(station, site_id, None)
    for answer in (
        client.get(f"/api/sites/{site_id}/maps3d/{RUN}/picture"),
        client.post(f"/api/sites/{site_id}/found-rows/of-run/{RUN}"),
    ):
        assert answer.status_code == 409
        assert "no place on the Earth" in answer.json()["message"]
    assert not (folder / "above.png").exists()
    assert list(station.settings.upload_dir.iterdir()) == []


@pytest.mark.parametrize(("harm", "name"), [(cut, "cloud.laz"), (cut, "map.ndt"), (Path.unlink, "map.ndt")])
def test_a_map_that_was_cut_off_or_lost_becomes_a_sentence_and_no_picture(
    client: TestClient, station: Station, site: SiteMap, site_id: str, harm: Callable[[Path], None], name: str
) -> None:
    folder = made(station, site_id, site.datum)
    harm(folder / name)
    answer = client.get(f"/api/sites/{site_id}/maps3d/{RUN}/picture")
    assert answer.status_code == 422, answer.text
    message = answer.json()["message"]
    assert name in message
    assert "make it again" in message
    assert str(folder) not in message
    assert not (folder / "above.png").exists()
    assert not (folder / "above.json").exists()


def found(client: TestClient, site_id: str) -> dict[str, Any]:
    """The job that looked for rows, at its end."""
    answer = client.post(f"/api/sites/{site_id}/found-rows/of-run/{RUN}")
    assert answer.status_code == 202, answer.text
    url = f"/api/jobs/{answer.json()['job_id']}"
    assert until(lambda: client.get(url).json()["state"] != "running", 300.0)
    job: dict[str, Any] = client.get(url).json()
    return job


def test_rows_are_found_in_the_farms_own_map_which_stays(
    client: TestClient, station: Station, site: SiteMap, site_id: str
) -> None:
    folder = made(station, site_id, site.datum)
    before = {file.name: file.read_bytes() for file in folder.iterdir()}
    job = found(client, site_id)
    assert job["state"] == "done", job
    proposal = client.get(f"/api/sites/{site_id}/found-rows").json()
    assert len(proposal["rows"]) == 2
    assert proposal["file_name"] == "The 3D map of “First row”"
    assert {file.name: file.read_bytes() for file in folder.iterdir()} == before
    assert list(station.settings.upload_dir.iterdir()) == []


def test_a_cut_off_cloud_of_the_farms_own_becomes_a_sentence_and_no_proposal(
    client: TestClient, station: Station, site: SiteMap, site_id: str
) -> None:
    folder = made(station, site_id, site.datum)
    cut(folder / "cloud.laz")
    job = found(client, site_id)
    assert job["state"] == "failed"
    assert "The 3D map of “First row”" in job["message"]
    assert str(station.settings.data_dir) not in job["message"]
    assert client.get(f"/api/sites/{site_id}/found-rows").json() is None


def test_a_map_of_another_place_is_not_laid_over_this_farm(
    client: TestClient, station: Station, site: SiteMap, site_id: str
) -> None:
    made(station, site_id, replace(site.datum, lat_deg=site.datum.lat_deg + 0.01))
    answer = client.post(f"/api/sites/{site_id}/found-rows/of-run/{RUN}")
    assert answer.status_code == 409
    assert "middle was moved" in answer.json()["message"]


def test_a_map_that_is_not_there_is_not_found(client: TestClient, site_id: str) -> None:
    for run_id in (RUN, "f" * 16):
        assert client.get(f"/api/sites/{site_id}/maps3d/{run_id}/picture").status_code == 404
        assert client.post(f"/api/sites/{site_id}/found-rows/of-run/{run_id}").status_code == 404


def test_lanelets_go_out_with_the_heights_of_the_ground_that_a_3d_map_knows(
    client: TestClient, station: Station, site: SiteMap, site_id: str
) -> None:
    url = f"/api/sites/{site_id}"
    drawn = replace(site, rows=(), lanes=(Lane(id="road", points=((-200.0, 0.0), (0.0, 3.0), (18.0, 3.0))),))
    stored = client.get(url).json()
    client.put(url, json={"version": stored["version"], "site": as_json(drawn)})
    assert not _heights(client.get(f"{url}/osm").content)
    folder = made(station, site_id, site.datum)
    heights = _heights(client.get(f"{url}/osm").content)
    assert heights[0.0] == pytest.approx(700.0, abs=0.05)  # m
    assert heights[18.0] == pytest.approx(700.0 + 18.0 * BLOCK.slope, abs=0.05)  # m
    assert -200.0 not in heights
    cut(folder / "map.ndt")
    assert not _heights(client.get(f"{url}/osm").content)


def _heights(osm: bytes) -> dict[float, float]:
    """Ellipsoidal height, m, of the lane's own points by x."""
    nodes = [node.tags for node in read_osm(osm).nodes.values() if "local_x" in node.tags and "ele" in node.tags]
    return {float(tags["local_x"]): float(tags["ele"]) for tags in nodes if tags["local_y"] in ("0.0", "3.0")}
