"""Finished orthophotos on disk and the tiles made of them."""

from __future__ import annotations

import os
import shutil
from contextlib import suppress
from pathlib import Path
from threading import Lock

import numpy as np
from rio_tiler.errors import TileOutsideBounds
from rio_tiler.io import Reader

from backend.errors import NotFoundError
from backend.gdal_setup import gdal, open_geotiff
from backend.png import encode_png
from backend.schemas import OrthophotoInfo
from navcore.disk import sync_folder, write_durably

TILE_PX = 256


class PictureStore:
    """`orthophotos/<id>.tif`, made by `backend.orthophoto_import`, and a cache that may be deleted at any time."""

    def __init__(self, picture_dir: Path, tile_dir: Path) -> None:
        picture_dir.mkdir(parents=True, exist_ok=True)
        self._picture_dir = picture_dir
        self._tile_dir = tile_dir
        self._empty = encode_png(np.zeros((TILE_PX, TILE_PX, 4), np.uint8))
        self._one_reader = Lock()

    def path(self, picture_id: str) -> Path:
        """Where the pixels of a picture are."""
        return self._picture_dir / f"{picture_id}.tif"

    def take_over(self, picture_id: str, finished: Path) -> None:
        """Move a finished picture here; on disk when this returns."""
        os.replace(finished, self.path(picture_id))
        sync_folder(self._picture_dir)

    def delete(self, picture_id: str) -> None:
        """Remove a picture and its tiles."""
        self.path(picture_id).unlink(missing_ok=True)
        shutil.rmtree(self._tile_dir / picture_id, ignore_errors=True)

    def delete_all_but(self, picture_ids: set[str]) -> None:
        """Remove what no site uses: left behind if the station died between two steps."""
        for file in self._picture_dir.glob("*.tif"):
            if file.stem not in picture_ids:
                self.delete(file.stem)

    def tile(self, picture: OrthophotoInfo | None, z: int, x: int, y: int) -> bytes:
        """PNG of 256 px, EPSG:3857, transparent outside. Raises NotFoundError without a picture or such a tile."""
        if picture is None:
            raise NotFoundError("This site has no orthophoto. Import one first.")
        if x >= 2**z or y >= 2**z:
            raise NotFoundError("There is no such tile.")
        cached = self._tile_dir / picture.id / str(z) / str(x) / f"{y}.png"
        if cached.is_file():
            return cached.read_bytes()
        png = self._render(picture, z, x, y)
        if png is not self._empty:
            with suppress(OSError):  # the cache may fail without harm, for example on a full disk
                write_durably(cached, png)
        return png

    def _render(self, picture: OrthophotoInfo, z: int, x: int, y: int) -> bytes:
        method = "nearest" if z > picture.max_zoom else "bilinear"
        with self._one_reader, gdal(), open_geotiff(self.path(picture.id)) as file:
            try:
                image = Reader(None, dataset=file).tile(x, y, z, tilesize=TILE_PX, resampling_method=method)
            except TileOutsideBounds:
                return self._empty
        rgba = np.dstack([*image.data[:3], image.mask])
        return encode_png(np.ascontiguousarray(rgba, np.uint8))
