"""A made-up orthophoto of a farm: what a drone would have seen, as a real GeoTIFF."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np
import rasterio
from numpy.typing import NDArray
from pyproj import Transformer
from rasterio import Affine
from shapely import MultiPoint

from navcore.geometry.geodesy import EnuFrame
from navcore.maps.site_map import Point, SiteMap, ZoneKind
from navcore.sim.orchard import Orchard, OrchardParams, build_orchard
from navcore.sim.shed import Shed

Floats = NDArray[np.float64]
Picture = NDArray[np.float32]
Line = Floats | tuple[Point, ...]
Colour = tuple[float, float, float]

# Colours, red green blue, 0 to 255.
_SOIL, _DRY_GRASS, _GREEN_GRASS = (172.0, 142.0, 108.0), (158.0, 150.0, 98.0), (112.0, 130.0, 68.0)
_ROAD, _TRACK, _RUT = (205.0, 187.0, 156.0), (188.0, 168.0, 132.0), (222.0, 206.0, 178.0)
_LEAF, _TREE, _WATER, _SHADOW = (74.0, 104.0, 44.0), (58.0, 84.0, 40.0), (66.0, 88.0, 84.0), (38.0, 36.0, 34.0)
_ROOF, _ROOF_SHADE, _RIDGE, _YARD = (
    (176.0, 82.0, 62.0),
    (146.0, 64.0, 50.0),
    (214.0, 150.0, 128.0),
    (196.0, 184.0, 164.0),
)
# cv2 takes coordinates as integers with this many fractional bits.
_BITS = 4


@dataclass(frozen=True, slots=True, kw_only=True)
class OrthophotoParams:
    """What the picture is like.

    Attributes:
        pixel_m: ground size of a pixel, 0.04 to 0.5.
        margin_m: of ground around the site.
        sun_azimuth: direction to the sun in `map`, rad from east. shadow_per_height: length of shadows.
        seed: of all that is random.
    """

    pixel_m: float = 0.08
    margin_m: float = 18.0
    sun_azimuth: float = -2.2
    shadow_per_height: float = 0.7
    seed: int = 7


def write_orthophoto(site: SiteMap, path: Path, params: OrthophotoParams | None = None) -> None:
    """Paint the site and write it as a tiled GeoTIFF in its UTM zone (WGS 84, EPSG 326xx or 327xx)."""
    p = params or OrthophotoParams()
    canvas = Canvas(site, p)
    picture = canvas.paint(build_orchard(site, OrchardParams(seed=p.seed)))
    profile = {
        "driver": "GTiff", "width": picture.shape[1], "height": picture.shape[0], "count": 3, "dtype": "uint8",
        "crs": f"EPSG:{canvas.epsg}", "transform": Affine(p.pixel_m, 0.0, canvas.west, 0.0, -p.pixel_m, canvas.north),
        "tiled": True, "blockxsize": 256, "blockysize": 256, "compress": "deflate", "predictor": 2,
        "photometric": "rgb", "interleave": "pixel",
    }  # fmt: skip
    path.parent.mkdir(parents=True, exist_ok=True)
    with rasterio.open(path, "w", **profile) as target:
        target.write(np.moveaxis(picture, 2, 0))


class Canvas:
    """Paints in pixels what is given in `map`; every corner is carried over exactly, so the picture is no sketch.

    Attributes:
        epsg: of the picture. west, north: its upper left corner, m.
    """

    def __init__(self, site: SiteMap, params: OrthophotoParams) -> None:
        self._site, self._params = site, params
        self._rng = np.random.default_rng(params.seed)
        self._frame = EnuFrame(site.datum)
        zone = int((site.datum.lon_deg + 180.0) // 6.0) + 1
        self.epsg = (32600 if site.datum.lat_deg >= 0.0 else 32700) + zone
        self._to_utm = Transformer.from_crs(4326, self.epsg, always_xy=True)
        corners = self._utm(_bounding_box(site, params.margin_m))
        self.west, self.north = float(corners[:, 0].min()), float(corners[:, 1].max())
        size = (corners.max(axis=0) - corners.min(axis=0)) / params.pixel_m
        self._width, self._height = math.ceil(size[0]), math.ceil(size[1])
        self._picture: Picture = np.zeros((self._height, self._width, 3), np.float32)

    def paint(self, orchard: Orchard) -> NDArray[np.uint8]:
        """The picture (H, W, 3), red green blue."""
        self._ground()
        self._vineyard(orchard)
        self._roads()
        self._zones()
        self._plants(orchard)
        self._trees(orchard)
        if orchard.shed is not None:
            self._building(orchard.shed)
        return self._developed()

    def _utm(self, points: Floats) -> Floats:
        """UTM (N, 2) of points (N, 2) in `map` on the ground."""
        lat, lon, _ = self._frame.to_geodetic(points[:, 0], points[:, 1], np.zeros(len(points)))
        return np.column_stack(self._to_utm.transform(lon, lat))

    def _pixels(self, points: Line) -> NDArray[np.int32]:
        """cv2's fixed-point pixels (N, 2) of points in `map`."""
        utm = self._utm(np.asarray(points, dtype=np.float64))
        pixels = np.column_stack((utm[:, 0] - self.west, self.north - utm[:, 1])) / self._params.pixel_m
        return np.round((pixels - 0.5) * (1 << _BITS)).astype(np.int32)

    def _fields(self, scale_m: float) -> Picture:
        """Smooth noise over the picture, (H, W), mean 0 and deviation 1, patches of about `scale_m`."""
        step = max(scale_m / self._params.pixel_m, 1.0)
        shape = max(round(self._height / step), 3), max(round(self._width / step), 3)
        coarse = self._rng.standard_normal(shape).astype(np.float32)
        return np.asarray(cv2.resize(coarse, (self._width, self._height), interpolation=cv2.INTER_CUBIC))

    def _blend(self, colour: Colour, share: Picture | Floats) -> None:
        """Lay a colour over the picture with an opacity (H, W) of 0 to 1."""
        self._picture += share.astype(np.float32)[..., None] * (np.array(colour, np.float32) - self._picture)

    def _mask(self, polygon: Line) -> Picture:
        mask = np.zeros((self._height, self._width), np.uint8)
        cv2.fillPoly(mask, [self._pixels(polygon)], 255, cv2.LINE_AA, _BITS)
        return mask.astype(np.float32) / 255.0

    def _lines(self, lines: Iterable[Line], width_m: float, blur_px: float = 0.0) -> Picture:
        """Coverage (H, W), 0 to 1, of lines of one width."""
        mask = np.zeros((self._height, self._width), np.uint8)
        thickness = max(round(width_m / self._params.pixel_m), 1)
        for line in lines:
            cv2.polylines(mask, [self._pixels(line)], False, 255, thickness, cv2.LINE_AA, _BITS)
        share = mask.astype(np.float32) / 255.0
        return _softened(share, blur_px) if blur_px else share

    def _ground(self) -> None:
        """Dry grass with greener and barer patches."""
        self._picture[:] = _DRY_GRASS
        patches = self._fields(14.0) + 0.6 * self._fields(5.0)
        self._blend(_GREEN_GRASS, np.clip(0.35 * patches, 0.0, 0.7))
        self._blend(_SOIL, np.clip(-0.35 * patches - 0.05, 0.0, 0.6))
        self._picture += 7.0 * self._fields(0.6)[..., None] + 5.0 * self._fields(0.15)[..., None]

    def _vineyard(self, orchard: Orchard) -> None:
        """Worked soil under the plants, grass in the middle of the alleys, headlands between the two."""
        for zone in self._site.zones:
            if zone.kind is ZoneKind.HEADLAND:
                self._blend(_TRACK, 0.30 * _softened(self._mask(zone.polygon), 12.0))
        alleys = [np.array((row.start, row.end)) for row in self._site.rows]
        widths = [row.width for row in self._site.rows]
        for width in sorted(set(widths)):
            self._blend(
                _SOIL, 0.85 * self._lines([a for a, w in zip(alleys, widths, strict=True) if w == width], width)
            )
        grass = self._lines(alleys, 0.45 * float(np.mean(widths or [3.0])), 4.0)
        self._blend(_GREEN_GRASS, grass * np.clip(0.55 + 0.25 * self._fields(1.2), 0.0, 0.9))
        self._blend(_TRACK, 0.4 * self._lines([_beside(a, side) for a in alleys for side in (-0.5, 0.5)], 0.25))
        self._blend(_SOIL, 0.8 * self._lines(orchard.plant_lines.reshape(-1, 2, 2), 0.9))

    def _roads(self) -> None:
        """The farm road, and grass tracks with two ruts."""
        for main in (False, True):
            lanes = [np.array(lane.points) for lane in self._site.lanes if (lane.id == "road") is main]
            worn = self._lines(lanes, 3.2 if main else 2.4, 2.5) * (1.0 + 0.2 * self._fields(0.8))
            self._blend(_ROAD if main else _TRACK, (0.9 if main else 0.55) * np.clip(worn, 0.0, 1.0))
            ruts = [_beside(lane, side) for lane in lanes for side in (-0.55, 0.55)]
            self._blend(_RUT, 0.55 * self._lines(ruts, 0.35, 1.5))

    def _zones(self) -> None:
        """Keep-out zones that are no building are water."""
        for zone in self._site.zones:
            if zone.kind is ZoneKind.KEEP_OUT and "shed" not in zone.name.lower():
                bank = _softened(self._mask(zone.polygon), 9.0)
                self._blend(_GREEN_GRASS, np.clip(1.4 * bank, 0.0, 1.0))
                inner = np.clip(2.2 * bank - 1.0, 0.0, 1.0)
                self._blend(_WATER, inner * np.clip(0.95 + 0.03 * self._fields(2.0), 0.0, 1.0))

    def _plants(self, orchard: Orchard) -> None:
        """Canopy as blobs along the lines, their shadows first."""
        spots = orchard.trunks[:, :2]
        n = len(spots)
        radius = self._rng.uniform(0.40, 0.72, n)
        shade = _shadow_offset(self._params, 1.3)
        self._blobs(spots + shade, radius, _SHADOW, 0.62)
        self._blobs(spots, radius, _LEAF, 0.95)
        self._blobs(
            spots - 0.25 * shade + self._rng.normal(0, 0.08, (n, 2)), 0.55 * radius, (104.0, 134.0, 62.0), 0.55
        )

    def _blobs(self, spots: Floats, radius: Floats, colour: Colour, share: float) -> None:
        """Soft ragged discs, each of a few smaller ones."""
        if not len(spots):
            return
        mask = np.zeros((self._height, self._width), np.uint8)
        for _ in range(4):
            moved = self._pixels(spots + self._rng.normal(0.0, 0.28, spots.shape) * radius[:, None] / 0.55)
            sizes = np.round(radius * 0.7 / self._params.pixel_m * (1 << _BITS)).astype(int)
            for (u, v), size in zip(moved.tolist(), sizes.tolist(), strict=True):
                cv2.circle(mask, (u, v), size, 255, -1, cv2.LINE_AA, _BITS)
        soft = _softened(mask.astype(np.float32) / 255.0, 1.2)
        self._blend(colour, share * np.clip(soft * (1.0 + 0.15 * self._fields(0.25)), 0.0, 1.0))

    def _trees(self, orchard: Orchard) -> None:
        """Single trees off everything that is drawn."""
        box = _bounding_box(self._site, self._params.margin_m - 4.0)
        spots = self._rng.uniform(box.min(axis=0), box.max(axis=0), (160, 2))
        free = spots[_clearance(spots, self._site) > 7.0][:26]
        radius = self._rng.uniform(1.2, 2.8, len(free))
        self._blobs(free + _shadow_offset(self._params, 3.5), radius, _SHADOW, 0.6)
        self._blobs(free, radius, _TREE, 0.97)
        self._blobs(free - _shadow_offset(self._params, 0.5), 0.6 * radius, (86.0, 112.0, 56.0), 0.6)

    def _building(self, shed: Shed) -> None:
        """A yard, the shadow, and a roof of two halves."""
        corners = _walls(shed, 1.0)
        self._blend(_YARD, 0.8 * _softened(self._mask(_walls(shed, 1.35)), 6.0))
        cast = np.vstack((corners, corners + _shadow_offset(self._params, shed.height)))
        shadow = np.array(MultiPoint(cast).convex_hull.exterior.coords)
        self._blend(_SHADOW, 0.65 * self._mask(shadow))
        self._blend(_ROOF, self._mask(corners))
        a, b, c, d = corners
        self._blend(_ROOF_SHADE, self._mask(np.array((a, b, (b + c) / 2, (a + d) / 2))))
        seams = [np.array((a + t * (b - a), d + t * (c - d))) for t in np.linspace(0.0, 1.0, 25)]
        self._blend(_ROOF_SHADE, 0.25 * self._lines(seams, 0.08))
        self._blend(_RIDGE, 0.7 * self._lines([np.array(((b + c) / 2, (a + d) / 2))], 0.16))

    def _developed(self) -> NDArray[np.uint8]:
        """A little uneven light, lens blur and sensor noise."""
        light = 1.0 + 0.03 * self._fields(40.0)
        picture = _softened(self._picture * light[..., None], 0.7)
        picture += self._rng.normal(0.0, 2.5, picture.shape).astype(np.float32)
        return np.clip(np.round(picture), 0.0, 255.0).astype(np.uint8)


def _softened(picture: Picture, deviation_px: float) -> Picture:
    return np.asarray(cv2.GaussianBlur(picture, (0, 0), deviation_px), dtype=np.float32)


def _bounding_box(site: SiteMap, margin: float) -> Floats:
    """Four corners (4, 2) in `map` around all that is drawn."""
    spots = [p for z in site.zones for p in z.polygon] + [p for lane in site.lanes for p in lane.points]
    spots += [p for row in site.rows for p in (row.start, row.end)]
    spots += [(site.warehouse.x, site.warehouse.y)] if site.warehouse else []
    low, high = np.min(spots or [(0.0, 0.0)], axis=0) - margin, np.max(spots or [(0.0, 0.0)], axis=0) + margin
    return np.array((low, (high[0], low[1]), high, (low[0], high[1])))


def _beside(points: Floats, left: float) -> Floats:
    """A line moved to its left, m."""
    direction = np.gradient(points, axis=0)
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    return points + left * np.column_stack((-direction[:, 1], direction[:, 0]))


def _shadow_offset(params: OrthophotoParams, height: float) -> Floats:
    length = params.shadow_per_height * height
    return -length * np.array((math.cos(params.sun_azimuth), math.sin(params.sun_azimuth)))


def _walls(shed: Shed, scale: float) -> Floats:
    """Corners (4, 2) in `map`; the first two are the ends of one long wall."""
    c, s = math.cos(shed.yaw), math.sin(shed.yaw)
    a, b = scale * shed.length / 2, scale * shed.depth / 2
    return np.array(
        [(shed.x + u * c - v * s, shed.y + u * s + v * c) for u, v in ((-a, -b), (a, -b), (a, b), (-a, b))]
    )


def _clearance(spots: Floats, site: SiteMap) -> Floats:
    """Distance (N,) to the nearest lane, row, headland or keep-out corner, by points every metre."""
    lines: list[tuple[Point, ...]] = [lane.points for lane in site.lanes]
    lines += [(row.start, row.end) for row in site.rows]
    lines += [(*z.polygon, z.polygon[0]) for z in site.zones if z.kind is not ZoneKind.KEEP_IN]
    known = np.concatenate([np.linspace(a, b, 40) for line in lines for a, b in pairwise(line)])
    return np.asarray(np.linalg.norm(spots[:, None] - known[None], axis=2).min(axis=1))
