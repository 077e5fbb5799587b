"""Orthophotos imported one after the other while the robot drives."""

from __future__ import annotations

from contextlib import suppress
from threading import Event, Thread

import numpy as np
from rasterio.io import MemoryFile
from rasterio.transform import from_origin

from navcore.bench.loop.station import LoopStation
from navcore.errors import TransportError

SIZE_PX = 5000
POLL_S = 0.5


class ImportLoad:
    """Uploads the same picture again whenever the last import has ended."""

    def __init__(self, station: LoopStation) -> None:
        self._station, self._ended = station, Event()
        self._picture = noisy_picture(SIZE_PX)
        self._thread = Thread(target=self._import_on, name="imports", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Begin no other import."""
        self._ended.set()
        self._thread.join()

    def _import_on(self) -> None:
        with suppress(TransportError, OSError):  # the station has ended
            while not self._ended.is_set():
                job = self._station.post("/api/orthophotos?name=bench.tif", raw=self._picture)["job_id"]
                while not self._ended.wait(POLL_S) and self._station.get(f"/api/jobs/{job}")["state"] == "running":
                    continue


def noisy_picture(size_px: int, seed: int = 1) -> bytes:
    """A GeoTIFF that compresses badly, 0.1 m a pixel."""
    rng = np.random.default_rng(seed)
    pixels = rng.integers(0, 255, (3, size_px, size_px), dtype=np.uint8)
    profile = {
        "driver": "GTiff", "width": size_px, "height": size_px, "count": 3, "dtype": "uint8", "crs": "EPSG:32630",
        "transform": from_origin(400_000.0, 4_600_000.0, 0.1, 0.1), "photometric": "rgb", "tiled": True,
    }  # fmt: skip
    with MemoryFile() as memory:
        with memory.open(**profile) as target:
            target.write(pixels)
        return bytes(memory.read())
