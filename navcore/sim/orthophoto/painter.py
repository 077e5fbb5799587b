"""A made-up orthophoto of a farm: what a drone would have seen, as a real GeoTIFF."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

import numpy as np
import rasterio
from numpy.typing import NDArray
from rasterio import Affine
from shapely import MultiPoint

from navcore.maps.site_map import Point, SiteMap, ZoneKind
from navcore.sim.orchard import Orchard, OrchardParams
from navcore.sim.orthophoto.canvas import Canvas, Floats, bounding_box, softened
from navcore.sim.orthophoto.params import OrthophotoParams
from navcore.sim.planting import build_orchard
from navcore.sim.shed import Shed

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


def write_orthophoto(site: SiteMap, path: Path, params: OrthophotoParams | None = None) -> None:
    """Paint the site and write it as a tiled GeoTIFF in its UTM zone (WGS 84, EPSG 326xx or 327xx)."""
    p = params or OrthophotoParams()
    canvas = Canvas(site, p)
    picture = _painted(canvas, site, build_orchard(site, OrchardParams(seed=p.seed)), p)
    profile = {
        "driver": "GTiff", "width": picture.shape[1], "height": picture.shape[0], "count": 3, "dtype": "uint8",
        "crs": f"EPSG:{canvas.epsg}", "transform": Affine(p.pixel_m, 0.0, canvas.west, 0.0, -p.pixel_m, canvas.north),
        "tiled": True, "blockxsize": 256, "blockysize": 256, "compress": "deflate", "predictor": 2,
        "photometric": "rgb", "interleave": "pixel",
    }  # fmt: skip
    path.parent.mkdir(parents=True, exist_ok=True)
    with rasterio.open(path, "w", **profile) as target:
        target.write(np.moveaxis(picture, 2, 0))


def _painted(canvas: Canvas, site: SiteMap, orchard: Orchard, params: OrthophotoParams) -> NDArray[np.uint8]:
    """The picture (H, W, 3), red green blue."""
    _ground(canvas)
    _vineyard(canvas, site, orchard)
    _roads(canvas, site)
    _zones(canvas, site)
    _plants(canvas, orchard, params)
    _trees(canvas, site, params)
    if orchard.shed is not None:
        _building(canvas, orchard.shed, params)
    return canvas.developed()


def _ground(canvas: Canvas) -> None:
    """Dry grass with greener and barer patches."""
    canvas.fill(_DRY_GRASS)
    patches = canvas.noise(14.0) + 0.6 * canvas.noise(5.0)
    canvas.blend(_GREEN_GRASS, np.clip(0.35 * patches, 0.0, 0.7))
    canvas.blend(_SOIL, np.clip(-0.35 * patches - 0.05, 0.0, 0.6))
    canvas.picture += 7.0 * canvas.noise(0.6) + 5.0 * canvas.noise(0.15)


def _vineyard(canvas: Canvas, site: SiteMap, orchard: Orchard) -> None:
    """Worked soil under the plants, grass in the middle of the alleys, headlands between the two."""
    for zone in site.zones:
        if zone.kind is ZoneKind.HEADLAND:
            canvas.blend(_TRACK, 0.30 * softened(canvas.mask(zone.polygon), 12.0))
    alleys = [np.array((row.start, row.end)) for row in site.rows]
    widths = [row.width for row in site.rows]
    for width in sorted(set(widths)):
        canvas.blend(
            _SOIL, 0.85 * canvas.lines([a for a, w in zip(alleys, widths, strict=True) if w == width], width)
        )
    grass = canvas.lines(alleys, 0.45 * float(np.mean(widths or [3.0])), 4.0)
    canvas.blend(_GREEN_GRASS, grass * np.clip(0.55 + 0.25 * canvas.noise(1.2), 0.0, 0.9))
    canvas.blend(_TRACK, 0.4 * canvas.lines([_beside(a, side) for a in alleys for side in (-0.5, 0.5)], 0.25))
    canvas.blend(_SOIL, 0.8 * canvas.lines(orchard.plant_lines.reshape(-1, 2, 2), 0.9))


def _roads(canvas: Canvas, site: SiteMap) -> None:
    """The farm road, and grass tracks with two ruts."""
    for main in (False, True):
        lanes = [np.array(lane.points) for lane in site.lanes if (lane.id == "road") is main]
        worn = canvas.lines(lanes, 3.2 if main else 2.4, 2.5) * (1.0 + 0.2 * canvas.noise(0.8))
        canvas.blend(_ROAD if main else _TRACK, (0.9 if main else 0.55) * np.clip(worn, 0.0, 1.0))
        ruts = [_beside(lane, side) for lane in lanes for side in (-0.55, 0.55)]
        canvas.blend(_RUT, 0.55 * canvas.lines(ruts, 0.35, 1.5))


def _zones(canvas: Canvas, site: SiteMap) -> None:
    """Keep-out zones that are no building are water."""
    for zone in site.zones:
        if zone.kind is ZoneKind.KEEP_OUT and "shed" not in zone.name.lower():
            bank = softened(canvas.mask(zone.polygon), 9.0)
            canvas.blend(_GREEN_GRASS, np.clip(1.4 * bank, 0.0, 1.0))
            inner = np.clip(2.2 * bank - 1.0, 0.0, 1.0)
            canvas.blend(_WATER, inner * np.clip(0.95 + 0.03 * canvas.noise(2.0), 0.0, 1.0))


def _plants(canvas: Canvas, orchard: Orchard, params: OrthophotoParams) -> None:
    """Canopy as blobs along the lines, their shadows first."""
    spots = orchard.trunks[:, :2]
    n = len(spots)
    radius = canvas.rng.uniform(0.40, 0.72, n)
    shade = _shadow_offset(params, 1.3)
    canvas.blobs(spots + shade, radius, _SHADOW, 0.62)
    canvas.blobs(spots, radius, _LEAF, 0.95)
    canvas.blobs(spots - 0.25 * shade + canvas.rng.normal(0, 0.08, (n, 2)), 0.55 * radius, (104.0, 134.0, 62.0), 0.55)


def _trees(canvas: Canvas, site: SiteMap, params: OrthophotoParams) -> None:
    """Single trees off everything that is drawn."""
    box = bounding_box(site, params.margin_m - 4.0)
    spots = canvas.rng.uniform(box.min(axis=0), box.max(axis=0), (160, 2))
    free = spots[_clearance(spots, site) > 7.0][:26]
    radius = canvas.rng.uniform(1.2, 2.8, len(free))
    canvas.blobs(free + _shadow_offset(params, 3.5), radius, _SHADOW, 0.6)
    canvas.blobs(free, radius, _TREE, 0.97)
    canvas.blobs(free - _shadow_offset(params, 0.5), 0.6 * radius, (86.0, 112.0, 56.0), 0.6)


def _building(canvas: Canvas, shed: Shed, params: OrthophotoParams) -> None:
    """A yard, the shadow, and a roof of two halves."""
    corners = _walls(shed, 1.0)
    canvas.blend(_YARD, 0.8 * softened(canvas.mask(_walls(shed, 1.35)), 6.0))
    cast = np.vstack((corners, corners + _shadow_offset(params, shed.height)))
    shadow = np.array(MultiPoint(cast).convex_hull.exterior.coords)
    canvas.blend(_SHADOW, 0.65 * canvas.mask(shadow))
    canvas.blend(_ROOF, canvas.mask(corners))
    a, b, c, d = corners
    canvas.blend(_ROOF_SHADE, canvas.mask(np.array((a, b, (b + c) / 2, (a + d) / 2))))
    seams = [np.array((a + t * (b - a), d + t * (c - d))) for t in np.linspace(0.0, 1.0, 25)]
    canvas.blend(_ROOF_SHADE, 0.25 * canvas.lines(seams, 0.08))
    canvas.blend(_RIDGE, 0.7 * canvas.lines([np.array(((b + c) / 2, (a + d) / 2))], 0.16))


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
