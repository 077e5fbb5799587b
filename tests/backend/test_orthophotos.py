"""Orthophotos: real ones become sites, bad ones become a sentence and leave nothing behind."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
import rasterio
from fastapi.testclient import TestClient
from rasterio.transform import Affine

from backend.orthophoto_check import CheckParams
from backend.orthophoto_import import import_picture
from backend.station import Station
from tests.backend.played_robot import until

pytestmark = pytest.mark.filterwarnings("ignore::PendingDeprecationWarning")  # rasterio, of its own affine
UTM = "EPSG:25830"
NORTH_UP = Affine(0.25, 0.0, 299454.5, 0.0, -0.25, 4596055.0)


def write(path: Path, bands: np.ndarray[Any, Any], **changes: Any) -> Path:
    """A GeoTIFF of (count, h, w) values."""
    count, height, width = bands.shape
    profile: dict[str, Any] = {
        "driver": "GTiff", "count": count, "height": height, "width": width, "dtype": bands.dtype, "crs": UTM,
        "transform": NORTH_UP,
    }  # fmt: skip
    with rasterio.open(path, "w", **(profile | changes)) as out:
        out.write(bands)
    return path


def colours(height: int = 300, width: int = 400) -> np.ndarray[Any, Any]:
    """Red left half, green right half."""
    picture = np.zeros((3, height, width), np.uint8)
    picture[0, :, : width // 2] = 200
    picture[1, :, width // 2 :] = 200
    return picture


def upload(client: TestClient, data: bytes, name: str = "farm.tif") -> dict[str, Any]:
    """Import over HTTP, to its end."""
    started = client.post("/api/orthophotos", params={"name": name}, content=data)
    assert started.status_code == 202, started.text
    address = f"/api/jobs/{started.json()['job_id']}"
    assert until(lambda: client.get(address).json()["state"] != "running", 60.0)
    job: dict[str, Any] = client.get(address).json()
    return job


def tile_at(client: TestClient, site: dict[str, Any], zoom: int, u: float, v: float) -> np.ndarray[Any, Any]:
    """RGBA of the tile that holds the point at share (u, v) of the picture from its upper left."""
    west, south, east, north = site["orthophoto"]["bounds_3857"]
    half = 20037508.342789244
    x, y = west + u * (east - west), north + v * (south - north)
    column, row = int((x + half) / (2 * half) * 2**zoom), int((half - y) / (2 * half) * 2**zoom)
    answer = client.get(f"/api/sites/{site['id']}/tiles/{zoom}/{column}/{row}.png")
    assert answer.status_code == 200, answer.text
    image = cv2.imdecode(np.frombuffer(answer.content, np.uint8), cv2.IMREAD_UNCHANGED)
    assert image is not None
    assert image.shape == (256, 256, 4)
    return cv2.cvtColor(image, cv2.COLOR_BGRA2RGBA)


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


BAD: dict[str, tuple[Callable[[Path], bytes], str]] = {
    "vrt": (lambda p: vrt(write(p, colours())), "cannot be read as a GeoTIFF"),
    "bomb": (sparse, "unpacks|Decoded"),
    "truncated": (truncated, "damaged|cannot be read"),
    "jpeg": (jpeg, "not as a photo"),
    "empty": (lambda p: b"", "cannot be read"),
    "text": (lambda p: b"hello" * 1000, "cannot be read"),
    "no crs": (lambda p: write(p, colours(), crs=None).read_bytes(), "does not say where on Earth"),
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


def silent(progress: float, message: str) -> None:
    """Tell nobody."""


@pytest.mark.parametrize("kind", ["grey", "palette", "uint16", "alpha", "nodata", "rotated", "geographic"])
def test_every_sane_form_of_picture_becomes_rgb(tmp_path: Path, kind: str) -> None:
    source, target, rgb = tmp_path / "in.tif", tmp_path / "out.tif", colours()
    alpha = np.full((1, 300, 400), 255, np.uint8)
    alpha[:, :100] = 0
    forms: dict[str, Callable[[], object]] = {
        "grey": lambda: write(source, rgb[:1]),
        "palette": lambda: write(source, rgb[:1] // 200),
        "uint16": lambda: write(source, rgb.astype(np.uint16) * 20),
        "alpha": lambda: write(source, np.concatenate([rgb, alpha]), photometric="RGB", alpha="YES"),
        "nodata": lambda: write(source, np.where(alpha > 0, np.maximum(rgb, 1), 0).astype(np.uint8), nodata=0),
        "rotated": lambda: write(source, rgb, transform=NORTH_UP @ Affine.rotation(30.0)),
        "geographic": lambda: write(source, rgb, crs="EPSG:4326", transform=Affine(3e-6, 0, -5.4, 0, -3e-6, 41.5)),
    }
    forms[kind]()
    if kind == "palette":
        with rasterio.open(source, "r+") as out:
            out.write_colormap(1, {0: (0, 200, 0, 255), 1: (200, 0, 0, 255)})
    import_picture(source, target, CheckParams(), silent)
    with rasterio.open(target) as made:
        assert (made.count, made.dtypes[0], made.block_shapes[0]) == (3, "uint8", (512, 512))
        assert made.transform.b == 0.0
        assert made.transform.e < 0.0
        mask, red = made.dataset_mask(), made.read(1)
    shown = float((mask > 0).mean())
    expected = {"alpha": 2 / 3, "nodata": 2 / 3}.get(kind, 1.0)
    assert 0.3 < shown < 0.9 if kind == "rotated" else shown == pytest.approx(expected, abs=0.01)
    if kind != "rotated":
        assert int(red[200, 50]) > 150
        assert int(red[200, 350]) < 60 or kind == "nodata"


LARGE_PX = 12_000
LARGE_BYTES = 3 * LARGE_PX**2  # 432 MB, decoded
PEAK_BYTES = 400e6  # what the import process may hold at most, libraries and GDAL's cache of blocks included


def large_picture(path: Path) -> Path:
    """A red field with a green right half, some noise in every tile, 12 000 x 12 000 pixels."""
    noise = np.random.default_rng(2).integers(0, 30, (3, 512, 512), np.uint8)
    profile = {"driver": "GTiff", "count": 3, "height": LARGE_PX, "width": LARGE_PX, "dtype": "uint8", "crs": UTM}
    layout = {"tiled": True, "blockxsize": 512, "blockysize": 512, "compress": "jpeg", "photometric": "YCBCR"}
    with rasterio.open(path, "w", transform=NORTH_UP, **profile, **layout) as out:
        for row in range(0, LARGE_PX, 512):
            for column in range(0, LARGE_PX, 512):
                height, width = min(512, LARGE_PX - row), min(512, LARGE_PX - column)
                tile = noise[:, :height, :width].copy()
                tile[0 if column + width / 2 < LARGE_PX / 2 else 1] += 180
                out.write(tile, window=rasterio.windows.Window(column, row, width, height))
    return path


@pytest.mark.slow
def test_a_picture_larger_than_the_memory_bound_is_imported_and_shown(client: TestClient, tmp_path: Path) -> None:
    """The import process never holds the whole picture; its peak is read from the kernel while it runs."""
    source = large_picture(tmp_path / "large.tif")
    with source.open("rb") as data:
        started = client.post("/api/orthophotos", params={"name": "large.tif"}, content=data)
    assert started.status_code == 202, started.text
    job: dict[str, Any] = {}
    peaks: list[int] = []

    def ended() -> bool:
        peaks.extend(peak_bytes(child) for child in import_processes())
        job.update(client.get(f"/api/jobs/{started.json()['job_id']}").json())
        return bool(job["state"] != "running")

    assert until(ended, 300.0)
    assert job["state"] == "done", job
    assert 30e6 < max(peaks) < PEAK_BYTES < LARGE_BYTES
    site = client.get(f"/api/sites/{job['site_id']}").json()
    assert site["orthophoto"]["width_px"] >= LARGE_PX
    for zoom in (site["orthophoto"]["min_zoom"], site["orthophoto"]["max_zoom"]):
        tile = tile_at(client, site, zoom, 0.25, 0.5)
        seen = tile[tile[..., 3] == 255]
        assert np.median(seen[:, 0]) > np.median(seen[:, 1]) + 100 or zoom == site["orthophoto"]["min_zoom"]
        assert len(seen) > 0


def import_processes() -> list[int]:
    """Children of this process that import a picture."""
    children = [child for t in Path("/proc/self/task").iterdir() for child in (t / "children").read_text().split()]
    return [int(child) for child in children if b"orthophoto_import" in _file(child, "cmdline")]


def peak_bytes(process: int) -> int:
    """Its largest resident memory so far; 0 if it has ended."""
    peak = re.search(rb"VmHWM:\s+(\d+) kB", _file(str(process), "status"))
    return int(peak[1]) * 1024 if peak else 0


def _file(process: str, name: str) -> bytes:
    try:
        return (Path("/proc") / process / name).read_bytes()
    except OSError:  # it has ended
        return b""


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
