"""The import process: `python -m backend.orthophoto_import SOURCE TARGET ...`, one JSON object a line on stdout.

It runs by itself, with limits on memory, processor and file size, because a GeoTIFF comes from anywhere and GDAL is
large. The pixels are copied in strips, so memory does not grow with the file. The copy is always the same kind of
file: 8 bit RGB, tiled, JPEG, with a mask and overviews, north up.
"""

from __future__ import annotations

import argparse
import ctypes
import json
import os
import resource
import sys
from collections.abc import Callable, Iterator
from dataclasses import asdict
from pathlib import Path

import numpy as np
import rasterio
from numpy.typing import NDArray
from rasterio.enums import ColorInterp, MaskFlags, Resampling
from rasterio.errors import RasterioError
from rasterio.io import DatasetReader, DatasetWriter
from rasterio.vrt import WarpedVRT
from rasterio.windows import Window

from backend.gdal_setup import gdal, open_geotiff
from backend.orthophoto_check import CheckParams, PictureFacts, check_bands, check_size, locate
from navcore.errors import OrthophotoError

BLOCK_PX = 512
STRIP_BYTES = 96 * 2**20
SAMPLE_PX = 1024
COPIED = 0.75  # share of the progress bar
CLONE_NEWUSER, CLONE_NEWNET = 0x10000000, 0x40000000  # linux/sched.h
NOT_READABLE = "This file cannot be read as a GeoTIFF. Export the orthophoto again as a GeoTIFF, not as a photo."
BROKEN = "This GeoTIFF is damaged: its pixels cannot be read to the end. Copy or export it again."
Image = NDArray[np.uint8]
Tell = Callable[[float, str], None]


def main() -> int:
    """Import one picture. Exit status 0 whenever the last line says how it went."""
    arguments = _arguments()
    limit_resources(arguments.memory_bytes, arguments.cpu_s)
    leave_network()
    try:
        facts = import_picture(
            arguments.source, arguments.target, CheckParams(decoded_bytes=arguments.decoded_bytes), tell
        )
    except OrthophotoError as error:
        say({"error": str(error)})
    except MemoryError:
        say({"error": "This picture needs too much memory. Export it tiled, with 8 bits per colour."})
    else:
        say({"done": asdict(facts)})
    return 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="backend.orthophoto_import")
    parser.add_argument("source", type=Path)
    parser.add_argument("target", type=Path)
    for name in ("--decoded-bytes", "--memory-bytes", "--cpu-s"):
        parser.add_argument(name, type=int, required=True)
    return parser.parse_args()


def limit_resources(memory_bytes: int, cpu_s: int) -> None:
    """For the rest of this process's life."""
    resource.setrlimit(resource.RLIMIT_AS, (memory_bytes, memory_bytes))
    resource.setrlimit(resource.RLIMIT_CPU, (cpu_s, cpu_s))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    os.nice(10)


def leave_network() -> None:
    """Into a network namespace without interfaces, where the kernel lets us; else only the driver list protects."""
    if sys.platform == "linux":
        ctypes.CDLL(None, use_errno=True).unshare(CLONE_NEWUSER | CLONE_NEWNET)


def say(line: dict[str, object]) -> None:
    """To the station."""
    sys.stdout.write(json.dumps(line) + "\n")
    sys.stdout.flush()


def tell(progress: float, message: str) -> None:
    """How far it is."""
    say({"progress": round(progress, 3), "message": message})


def import_picture(source: Path, target: Path, params: CheckParams, tell: Tell) -> PictureFacts:
    """Check and copy. Raises OrthophotoError; then `target` is no picture and must be deleted."""
    with gdal():
        tell(0.0, "Checking the file")
        try:
            picture = open_geotiff(source)
        except RasterioError as error:
            raise OrthophotoError(NOT_READABLE) from error
        with picture:
            check_size(picture, source.stat().st_size, params)
            bands = check_bands(picture)
            facts = locate(picture, params)
            try:
                copy(picture, bands, target, tell)
                build_overviews(target, tell)
            except RasterioError as error:
                raise OrthophotoError(BROKEN) from error
    return facts


def copy(picture: DatasetReader, bands: tuple[int, ...], target: Path, tell: Tell) -> None:
    """Strip by strip into our own kind of file."""
    scale = Scale.of(picture, bands)
    with north_up(picture) as upright, rasterio.open(target, "w", **profile(upright)) as out:
        windows = list(strips(upright))
        for done, window in enumerate(windows):
            rgb, mask = read_strip(upright, bands, window, scale)
            out.write(rgb, window=window)
            out.write_mask(mask, window=window)
            tell(0.02 + (COPIED - 0.02) * (done + 1) / len(windows), "Copying the picture")


def north_up(picture: DatasetReader) -> DatasetReader | WarpedVRT:
    """The picture itself, or a view of it that is turned upright; either is closed by its context."""
    t = picture.transform
    if t.b == 0.0 and t.d == 0.0 and t.e < 0.0 < t.a:
        return picture
    return WarpedVRT(picture, crs=picture.crs, add_alpha=not has_alpha(picture), resampling=Resampling.bilinear)


def has_alpha(picture: DatasetReader | WarpedVRT) -> bool:
    """Whether a band tells transparency."""
    return ColorInterp.alpha in picture.colorinterp


def profile(picture: DatasetReader | WarpedVRT) -> dict[str, object]:
    """Of our own kind of file."""
    return {
        "driver": "GTiff",
        "width": picture.width,
        "height": picture.height,
        "count": 3,
        "dtype": "uint8",
        "crs": picture.crs,
        "transform": picture.transform,
        "tiled": True,
        "blockxsize": BLOCK_PX,
        "blockysize": BLOCK_PX,
        "compress": "JPEG",
        "jpeg_quality": 90,
        "photometric": "YCBCR",
        "bigtiff": "IF_SAFER",
    }


def strips(picture: DatasetReader | WarpedVRT) -> Iterator[Window]:
    """Windows one block high, as wide as memory allows, aligned to the target's blocks."""
    pixel_bytes = 4 + sum(np.dtype(kind).itemsize for kind in picture.dtypes)
    width = max(1, STRIP_BYTES // (pixel_bytes * BLOCK_PX * BLOCK_PX)) * BLOCK_PX
    for row in range(0, picture.height, BLOCK_PX):
        for column in range(0, picture.width, width):
            size = min(width, picture.width - column), min(BLOCK_PX, picture.height - row)
            yield Window(column, row, *size)


def read_strip(
    picture: DatasetReader | WarpedVRT, bands: tuple[int, ...], window: Window, scale: Scale
) -> tuple[Image, Image]:
    """Colours (3, h, w) and mask (h, w), 255 where there is picture."""
    values = picture.read(bands, window=window)
    mask: Image = (
        picture.dataset_mask(window=window) if has_mask(picture) else np.full(values.shape[1:], 255, np.uint8)
    )
    rgb = scale.to_rgb(values)
    return np.where(mask > 0, rgb, 0).astype(np.uint8), np.where(mask > 0, 255, 0).astype(np.uint8)


def has_mask(picture: DatasetReader | WarpedVRT) -> bool:
    """Whether some pixels are no picture: alpha, nodata value or mask."""
    return any(MaskFlags.all_valid not in flags for flags in picture.mask_flag_enums)


class Scale:
    """From stored values to 8 bit colours: palette, 16 bit stretched from 1st to 99th percentile, or as is."""

    def __init__(self, palette: Image | None, low: float, high: float) -> None:
        """`palette` is (256, 3); `low` and `high` are stored values that become 0 and 255."""
        self._palette = palette
        self._low = low
        self._high = high

    @classmethod
    def of(cls, picture: DatasetReader, bands: tuple[int, ...]) -> Scale:
        """Looks at a reduced copy of 16 bit pictures; 8 bit ones are taken as they are."""
        if picture.colorinterp[bands[0] - 1] is ColorInterp.palette:
            return cls(palette_of(picture, bands[0]), 0.0, 255.0)
        if picture.dtypes[0] == "uint8":
            return cls(None, 0.0, 255.0)
        shape = (len(bands), min(SAMPLE_PX, picture.height), min(SAMPLE_PX, picture.width))
        sample = picture.read(bands, out_shape=shape, masked=True).compressed()
        if sample.size == 0:
            raise OrthophotoError("This picture is empty: it has no pixel that is valid.")
        low, high = np.percentile(sample, (1.0, 99.0))
        return cls(None, float(low), float(max(high, low + 1.0)))

    def to_rgb(self, values: NDArray[np.generic]) -> Image:
        """(1 or 3, h, w) stored values to (3, h, w)."""
        if self._palette is not None:
            return np.ascontiguousarray(np.moveaxis(self._palette[values[0].astype(np.uint8)], -1, 0))
        colours = values if len(values) == 3 else np.repeat(values[:1], 3, axis=0)
        if colours.dtype == np.uint8:
            return colours.astype(np.uint8, copy=False)
        stretched = (colours.astype(np.float32) - self._low) * (255.0 / (self._high - self._low))
        return np.asarray(np.clip(stretched, 0.0, 255.0), np.uint8)


def palette_of(picture: DatasetReader, band: int) -> Image:
    """(256, 3) colours of a palette."""
    palette = np.zeros((256, 3), np.uint8)
    for value, colour in picture.colormap(band).items():
        if 0 <= value < 256:
            palette[value] = colour[:3]
    return palette


def build_overviews(target: Path, tell: Tell) -> None:
    """Halved copies inside of the file, until one block holds all."""
    with rasterio.open(target, "r+") as out:
        factors = [2**n for n in range(1, 20) if max(out.width, out.height) // 2 ** (n - 1) > BLOCK_PX]
        for done, factor in enumerate(factors):
            add_overview(out, factor)
            tell(COPIED + (1.0 - COPIED) * (done + 1) / len(factors), "Making smaller copies for the map")


def add_overview(out: DatasetWriter, factor: int) -> None:
    """One reduced copy, made of the one before."""
    out.build_overviews([factor], Resampling.average)


if __name__ == "__main__":
    raise SystemExit(main())
