"""Orthophotos made for the tests, how they are handed in, and how the map shows them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2
import numpy as np
import rasterio
from fastapi.testclient import TestClient
from rasterio.transform import Affine

from tests.backend.played_robot import until

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
