"""The copy of an orthophoto, always of one kind: 8 bit RGB, tiled, JPEG, with a mask and overviews, north up.

The pixels are copied in strips, so memory does not grow with the file.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import rasterio
from rasterio.enums import ColorInterp, MaskFlags, Resampling
from rasterio.io import DatasetReader, DatasetWriter
from rasterio.vrt import WarpedVRT
from rasterio.windows import Window

from backend.orthophoto_colours import EMPTY, Image, Scale
from navcore.errors import OrthophotoError

BLOCK_PX = 512
STRIP_BYTES = 96 * 2**20
COPIED = 0.75  # share of the progress bar
Tell = Callable[[float, str], None]


def copy(picture: DatasetReader, bands: tuple[int, ...], target: Path, tell: Tell) -> None:
    """Strip by strip into our own kind of file. Raises OrthophotoError if no pixel of it is valid."""
    scale, empty = Scale.of(picture, bands), True
    with north_up(picture) as upright, rasterio.open(target, "w", **profile(upright)) as out:
        windows = list(strips(upright))
        for done, window in enumerate(windows):
            rgb, mask = read_strip(upright, bands, window, scale)
            out.write(rgb, window=window)
            out.write_mask(mask, window=window)
            empty = empty and not mask.any()
            tell(0.02 + (COPIED - 0.02) * (done + 1) / len(windows), "Copying the picture")
    if empty:
        raise OrthophotoError(EMPTY)


def north_up(picture: DatasetReader) -> DatasetReader | WarpedVRT:
    """The picture itself, or a view of it that is turned upright; either is closed by its context.

    Between two places in a palette lies a third colour, so those are not mixed.
    """
    t = picture.transform
    if t.b == 0.0 and t.d == 0.0 and t.e < 0.0 < t.a:
        return picture
    between = Resampling.nearest if ColorInterp.palette in picture.colorinterp else Resampling.bilinear
    return WarpedVRT(picture, crs=picture.crs, add_alpha=not has_alpha(picture), resampling=between)


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
