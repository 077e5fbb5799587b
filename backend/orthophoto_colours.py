"""From a picture's stored values to 8 bit colours."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from rasterio.enums import ColorInterp
from rasterio.io import DatasetReader

from navcore.errors import OrthophotoError

EMPTY = "This picture is empty: it has no pixel that is valid."
SAMPLE_PX = 1024
Image = NDArray[np.uint8]


class Scale:
    """From stored values to 8 bit colours: palette, 16 bit stretched from 1st to 99th percentile, or as is.

    Where white is stored as 0, `low` is above `high`.
    """

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
            return cls(None, *_turned(picture, 0.0, largest_of(picture, bands[0])))
        shape = (len(bands), min(SAMPLE_PX, picture.height), min(SAMPLE_PX, picture.width))
        sample = picture.read(bands, out_shape=shape, masked=True).compressed()
        if sample.size == 0:
            raise OrthophotoError(EMPTY)
        low, high = np.percentile(sample, (1.0, 99.0))
        return cls(None, *_turned(picture, float(low), float(max(high, low + 1.0))))

    def to_rgb(self, values: NDArray[np.generic]) -> Image:
        """(1 or 3, h, w) stored values to (3, h, w)."""
        if self._palette is not None:
            return np.ascontiguousarray(np.moveaxis(self._palette[values[0].astype(np.uint8)], -1, 0))
        colours = values if len(values) == 3 else np.repeat(values[:1], 3, axis=0)
        if colours.dtype == np.uint8 and (self._low, self._high) == (0.0, 255.0):
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


def largest_of(picture: DatasetReader, band: int) -> float:
    """Largest value that a band of at most 8 bits can hold."""
    return float(2 ** int(picture.tags(band, ns="IMAGE_STRUCTURE").get("NBITS", 8)) - 1)


def _turned(picture: DatasetReader, low: float, high: float) -> tuple[float, float]:
    white_is_zero = picture.tags(ns="IMAGE_STRUCTURE").get("MINISWHITE") == "YES"
    return (high, low) if white_is_zero else (low, high)
