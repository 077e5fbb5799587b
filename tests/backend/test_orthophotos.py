"""Orthophotos: real ones become sites, bad ones become a sentence and leave nothing behind."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest
import rasterio
from fastapi.testclient import TestClient
from rasterio.control import GroundControlPoint
from rasterio.transform import Affine

from backend.station import Station
from tests.backend.pictures import NORTH_UP, UTM, colours, tile_at, upload, write
from tests.backend.played_robot import until

pytestmark = pytest.mark.filterwarnings("ignore::PendingDeprecationWarning")  # rasterio, of its own affine


def test_an_orthophoto_becomes_a_site_with_tiles(client: TestClient, station: Station, tmp_path: Path) -> None:
    job = upload(client, write(tmp_path / "p.tif", colours(), compress="deflate").read_bytes(), "../My farm.tif")
    assert job["state"] == "done", job
    site = client.get(f"/api/sites/{job['site_id']}").json()
    assert site["name"] == "My farm"
    info = site["orthophoto"]
    assert info["resolution"] == pytest.approx(0.25, rel=2e-3)  # m
    assert site["site"]["datum"]["lat_deg"] == pytest.approx(
        (info["bounds_deg"][1] + info["bounds_deg"][3]) / 2, abs=1e-6
    )
    assert site["site"]["datum"]["frame"] == "ETRS89"
    whole = tile_at(client, site, info["min_zoom"], 0.5, 0.5)
    assert set(np.unique(whole[..., 3])) >= {0, 255}
    left = tile_at(client, site, info["max_zoom"], 0.1, 0.5)
    seen = left[left[..., 3] == 255]
    assert np.median(seen[:, 0]) == pytest.approx(200, abs=12)
    outside = client.get(f"/api/sites/{site['id']}/tiles/5/0/0.png")
    blank = cv2.imdecode(np.frombuffer(outside.content, np.uint8), cv2.IMREAD_UNCHANGED)
    assert blank is not None
    assert blank[..., 3].max() == 0
    assert client.get(f"/api/sites/{site['id']}/tiles/3/9/0.png").status_code == 404
    assert client.delete(f"/api/sites/{site['id']}").status_code == 204
    assert list(station.settings.orthophoto_dir.iterdir()) == []
    assert list(station.settings.upload_dir.iterdir()) == []


def vrt(path: Path) -> bytes:
    return (
        f'<VRTDataset rasterXSize="100" rasterYSize="100"><VRTRasterBand dataType="Byte" band="1"><SimpleSource>'
        f'<SourceFilename relativeToVRT="0">{path}</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>'
    ).encode()


def sparse(path: Path) -> bytes:
    profile = {"driver": "GTiff", "count": 3, "height": 100_000, "width": 100_000, "dtype": "uint8", "crs": UTM}
    with rasterio.open(
        path, "w", transform=NORTH_UP, tiled=True, blockxsize=8192, blockysize=8192, SPARSE_OK=True,
        compress="deflate", bigtiff="YES", **profile,
    ):  # fmt: skip
        pass
    assert path.stat().st_size < 30_000
    return path.read_bytes()


def truncated(path: Path) -> bytes:
    noise = np.random.default_rng(1).integers(0, 255, (3, 300, 400), np.uint8)
    return write(path, noise).read_bytes()[:200_000]


def jpeg(path: Path) -> bytes:
    done, data = cv2.imencode(".jpg", np.zeros((100, 100, 3), np.uint8))
    assert done
    return bytes(data)


def control_points_only(path: Path) -> bytes:
    write(path, colours(), crs=None, transform=Affine.identity())
    corners = [(0, 0), (0, 400), (300, 0), (300, 400)]
    points = [GroundControlPoint(row, column, *(NORTH_UP @ (column, row))) for row, column in corners]
    with rasterio.open(path, "r+") as out:
        out.gcps = (points, rasterio.CRS.from_string(UTM))
    return path.read_bytes()


BAD: dict[str, tuple[Callable[[Path], bytes], str]] = {
    "vrt": (lambda p: vrt(write(p, colours())), "cannot be read as a GeoTIFF"),
    "bomb": (sparse, "unpacks|Decoded"),
    "truncated": (truncated, "damaged|cannot be read"),
    "jpeg": (jpeg, "not as a photo"),
    "empty": (lambda p: b"", "cannot be read"),
    "text": (lambda p: b"hello" * 1000, "cannot be read"),
    "no crs": (lambda p: write(p, colours(), crs=None).read_bytes(), "does not say where on Earth"),
    "control points": (control_points_only, "Rectify it first"),
    "nothing valid": (lambda p: write(p, colours() * 0, nodata=0).read_bytes(), "has no pixel that is valid"),
    "across the map's edge": (
        lambda p: write(
            p, colours(), crs="EPSG:4326", transform=Affine(1e-5, 0, 179.999, 0, -1e-5, -17.0)
        ).read_bytes(),
        "180th meridian",
    ),
    "no place": (lambda p: write(p, colours(), transform=Affine.identity()).read_bytes(), "where its pixels lie"),
    "local": (
        lambda p: write(p, colours(), crs='LOCAL_CS["field",UNIT["metre",1]]').read_bytes(),
        "local coordinate system|not known|does not say where",
    ),
    "off the Earth": (
        lambda p: write(p, colours(), crs="EPSG:4326", transform=Affine(1e-5, 0, 400.0, 0, -1e-5, 95.0)).read_bytes(),
        "outside|poles",
    ),
    "float": (lambda p: write(p, colours().astype(np.float32)).read_bytes(), "float32 values"),
    "coarse": (
        lambda p: write(p, colours(), transform=Affine(30.0, 0, 299454.5, 0, -30.0, 4596055.0)).read_bytes(),
        "30 m of ground",
    ),
}


@pytest.mark.filterwarnings("ignore::rasterio.errors.NotGeoreferencedWarning")
@pytest.mark.parametrize("kind", BAD)
def test_a_bad_picture_is_refused_in_a_sentence_and_leaves_nothing(
    client: TestClient, station: Station, tmp_path: Path, kind: str
) -> None:
    make, sentence = BAD[kind]
    job = upload(client, make(tmp_path / "bad.tif"))
    assert job["state"] == "failed"
    assert any(part in job["message"] for part in sentence.split("|")), job["message"]
    assert client.get("/api/sites").json() == []
    assert list(station.settings.orthophoto_dir.iterdir()) == []
    assert until(lambda: list(station.settings.upload_dir.iterdir()) == [])


def test_the_real_pictures_are_imported_or_refused(client: TestClient, shared_data: Path, station: Station) -> None:
    files = [path for path in sorted((shared_data / "orthophotos").rglob("*.tif*")) if path.is_file()]
    done = {path.name: upload(client, path.read_bytes(), path.name) for path in files}
    assert len(done) >= 9
    imported = {name for name, job in done.items() if job["state"] == "done"}
    assert {name for name in done if name.startswith(("PNOA", "test_raster", "alpha"))} == imported
    for name in set(done) - imported:
        assert "station" not in done[name]["message"], done[name]
    farm = next(s for s in client.get("/api/sites").json() if "0398" in s["name"])
    document = client.get(f"/api/sites/{farm['id']}").json()
    assert document["orthophoto"]["width_px"] == 947
    roof = tile_at(client, document, 22, 350 / 947, 205 / 1110)
    assert (roof[..., 3] == 255).all()
    assert np.median(roof[..., 0]) > np.median(roof[..., 2]) + 20  # the shed's roof is red
