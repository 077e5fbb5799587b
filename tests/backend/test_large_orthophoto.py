"""A picture larger than the memory that its import may use."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import rasterio
from fastapi.testclient import TestClient

from tests.backend.pictures import NORTH_UP, UTM, tile_at
from tests.backend.played_robot import until

pytestmark = pytest.mark.filterwarnings("ignore::PendingDeprecationWarning")  # rasterio, of its own affine
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
@pytest.mark.realtime  # imports give way to everything else
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

    assert until(ended, 500.0)
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
    threads = [thread.name for thread in Path("/proc/self/task").iterdir()]
    children = [child.decode() for thread in threads for child in _file(f"self/task/{thread}", "children").split()]
    return [int(child) for child in children if b"orthophoto_import" in _file(child, "cmdline")]


def peak_bytes(process: int) -> int:
    """Its largest resident memory so far; 0 if it has ended."""
    peak = re.search(rb"VmHWM:\s+(\d+) kB", _file(str(process), "status"))
    return int(peak[1]) * 1024 if peak else 0


def _file(process: str, name: str) -> bytes:
    try:
        return (Path("/proc") / process / name).read_bytes()
    except OSError:  # it, or the thread, has ended
        return b""
