"""The sheet that an orthophoto is painted on: from `map` to pixels, and the brushes."""

from __future__ import annotations

import math
from collections.abc import Iterable

import cv2
import numpy as np
from numpy.typing import NDArray
from pyproj import Transformer

from navcore.geometry.geodesy import EnuFrame
from navcore.maps.site_map import Point, SiteMap
from navcore.sim.orthophoto.params import OrthophotoParams

Floats = NDArray[np.float64]
Picture = NDArray[np.float32]
Line = Floats | tuple[Point, ...]
Colour = tuple[float, float, float]

# cv2 takes coordinates as integers with this many fractional bits.
_BITS = 4


class Canvas:
    """Paints in pixels what is given in `map`; every corner is carried over exactly, so the picture is no sketch.

    Attributes:
        epsg: of the picture. west, north: its upper left corner, m.
        rng: of all that is random. picture: (3, H, W), red green blue, 0 to 255: a plane each, which is blended in a
            fifth of the time that three numbers side by side take.
    """

    def __init__(self, site: SiteMap, params: OrthophotoParams) -> None:
        self._params = params
        self.rng = np.random.default_rng(params.seed)
        self._frame = EnuFrame(site.datum)
        zone = int((site.datum.lon_deg + 180.0) // 6.0) + 1
        self.epsg = (32600 if site.datum.lat_deg >= 0.0 else 32700) + zone
        self._to_utm = Transformer.from_crs(4326, self.epsg, always_xy=True)
        corners = self.utm(bounding_box(site, params.margin_m))
        self.west, self.north = float(corners[:, 0].min()), float(corners[:, 1].max())
        size = (corners.max(axis=0) - corners.min(axis=0)) / params.pixel_m
        self._width, self._height = math.ceil(size[0]), math.ceil(size[1])
        self.picture: Picture = np.zeros((3, self._height, self._width), np.float32)

    def utm(self, points: Floats) -> Floats:
        """UTM (N, 2) of points (N, 2) in `map` on the ground."""
        lat, lon, _ = self._frame.to_geodetic(points[:, 0], points[:, 1], np.zeros(len(points)))
        return np.column_stack(self._to_utm.transform(lon, lat))

    def pixels(self, points: Line) -> NDArray[np.int32]:
        """cv2's fixed-point pixels (N, 2) of points in `map`."""
        utm = self.utm(np.asarray(points, dtype=np.float64))
        pixels = np.column_stack((utm[:, 0] - self.west, self.north - utm[:, 1])) / self._params.pixel_m
        return np.round((pixels - 0.5) * (1 << _BITS)).astype(np.int32)

    def noise(self, scale_m: float) -> Picture:
        """Smooth noise over the picture, (H, W), mean 0 and deviation 1, patches of about `scale_m`."""
        step = max(scale_m / self._params.pixel_m, 1.0)
        shape = max(round(self._height / step), 3), max(round(self._width / step), 3)
        coarse = self.rng.standard_normal(shape).astype(np.float32)
        return np.asarray(cv2.resize(coarse, (self._width, self._height), interpolation=cv2.INTER_CUBIC))

    def blend(self, colour: Colour, share: Picture | Floats) -> None:
        """Lay a colour over the picture with an opacity (H, W) of 0 to 1."""
        opacity = share.astype(np.float32)
        for plane, value in zip(self.picture, colour, strict=True):
            plane += opacity * (np.float32(value) - plane)

    def fill(self, colour: Colour) -> None:
        """Nothing but that colour."""
        self.picture[:] = np.array(colour, np.float32)[:, None, None]

    def mask(self, polygon: Line) -> Picture:
        mask = np.zeros((self._height, self._width), np.uint8)
        cv2.fillPoly(mask, [self.pixels(polygon)], 255, cv2.LINE_AA, _BITS)
        return mask.astype(np.float32) / 255.0

    def lines(self, lines: Iterable[Line], width_m: float, blur_px: float = 0.0) -> Picture:
        """Coverage (H, W), 0 to 1, of lines of one width."""
        mask = np.zeros((self._height, self._width), np.uint8)
        thickness = max(round(width_m / self._params.pixel_m), 1)
        for line in lines:
            cv2.polylines(mask, [self.pixels(line)], False, 255, thickness, cv2.LINE_AA, _BITS)
        share = mask.astype(np.float32) / 255.0
        return softened(share, blur_px) if blur_px else share

    def blobs(self, spots: Floats, radius: Floats, colour: Colour, share: float) -> None:
        """Soft ragged discs, each of a few smaller ones."""
        if not len(spots):
            return
        mask = np.zeros((self._height, self._width), np.uint8)
        for _ in range(4):
            moved = self.pixels(spots + self.rng.normal(0.0, 0.28, spots.shape) * radius[:, None] / 0.55)
            sizes = np.round(radius * 0.7 / self._params.pixel_m * (1 << _BITS)).astype(int)
            for (u, v), size in zip(moved.tolist(), sizes.tolist(), strict=True):
                cv2.circle(mask, (u, v), size, 255, -1, cv2.LINE_AA, _BITS)
        soft = softened(mask.astype(np.float32) / 255.0, 1.2)
        self.blend(colour, share * np.clip(soft * (1.0 + 0.15 * self.noise(0.25)), 0.0, 1.0))

    def developed(self) -> NDArray[np.uint8]:
        """The picture (H, W, 3) with a little uneven light, lens blur and sensor noise."""
        light = 1.0 + 0.03 * self.noise(40.0)
        planes = [softened(plane * light, 0.7) for plane in self.picture]
        picture = np.asarray(cv2.merge(planes), dtype=np.float32)
        picture += self.rng.normal(0.0, 2.5, picture.shape).astype(np.float32)
        return np.clip(np.round(picture), 0.0, 255.0).astype(np.uint8)


def softened(picture: Picture, deviation_px: float) -> Picture:
    return np.asarray(cv2.GaussianBlur(picture, (0, 0), deviation_px), dtype=np.float32)


def bounding_box(site: SiteMap, margin: float) -> Floats:
    """Four corners (4, 2) in `map` around all that is drawn."""
    spots = [p for z in site.zones for p in z.polygon] + [p for lane in site.lanes for p in lane.points]
    spots += [p for row in site.rows for p in (row.start, row.end)]
    spots += [(site.warehouse.x, site.warehouse.y)] if site.warehouse else []
    low, high = np.min(spots or [(0.0, 0.0)], axis=0) - margin, np.max(spots or [(0.0, 0.0)], axis=0) + margin
    return np.array((low, (high[0], low[1]), high, (low[0], high[1])))
