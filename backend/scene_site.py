"""The farm in the 3D view: posts and trunks beside every row, roads, zones, the warehouse. Frame: `map`, z up."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from viser import SceneApi

from navcore.maps.site_map import Lane, Row, SiteMap, Warehouse, ZoneKind

Floats = NDArray[np.float32]
Points = NDArray[np.float64]
POST_M, TRUNK_M, WIRE_M = 2.0, 1.0, 1.8  # heights for the eye; the site map holds none
WAREHOUSE_M = 3.0  # side of its outline
ON_GROUND = 0.03
MOST_UPRIGHTS = 20_000  # of each kind; a larger farm is shown thinned, so that a browser can still turn it
POST, TRUNK, WIRE, ROAD, HOUSE = (110, 110, 115), (125, 85, 50), (90, 150, 80), (165, 150, 120), (60, 60, 70)
ZONES = {ZoneKind.KEEP_OUT: (210, 50, 50)}
OTHER_ZONE = (200, 160, 40)


def show_site(scene: SceneApi, site: SiteMap, planted: tuple[Row, ...]) -> None:
    """Draw `site` in the place of the one shown before, with plants where `planted` rows' spacing puts them."""
    scene.remove_by_name("/site")
    scene.add_frame("/site", show_axes=False)
    _lines(scene, "/site/posts", posts(planted), POST, 0.10)
    _lines(scene, "/site/trunks", trunks(planted), TRUNK, 0.07)
    _lines(scene, "/site/wires", wires(site.rows), WIRE, 0.03)
    _lines(scene, "/site/roads", roads(site.lanes), ROAD, 0.10)
    for zone in site.zones:
        outline = closed(np.array(zone.polygon))
        _lines(scene, f"/site/zone_{zone.id}", outline, ZONES.get(zone.kind, OTHER_ZONE), 0.08)
    if site.warehouse is not None:
        _lines(scene, "/site/warehouse", closed(corners(site.warehouse)), HOUSE, 0.12)


def _lines(scene: SceneApi, name: str, segments: Floats, colour: tuple[int, int, int], thickness: float) -> None:
    if len(segments):
        scene.add_line_segments(name, points=segments, colors=colour, thickness=thickness)


def posts(rows: tuple[Row, ...]) -> Floats:
    """(N, 2, 3) uprights on both lines of plants of every row."""
    return uprights([line for row in rows for line in _plants(row, row.post_spacing, first=0.0)], POST_M)


def trunks(rows: tuple[Row, ...]) -> Floats:
    """(N, 2, 3), between the posts, where the spacing of the plants puts them."""
    return uprights(
        [line for row in rows for line in _plants(row, row.plant_spacing, row.plant_spacing / 2.0)], TRUNK_M
    )


def wires(rows: tuple[Row, ...]) -> Floats:
    """(2 rows, 2, 3): along each line of plants."""
    ends = [side for row in rows for side in sides(row)]
    return lifted(np.array(ends), WIRE_M) if ends else nothing()


def roads(lanes: tuple[Lane, ...]) -> Floats:
    """(N, 2, 3): their centre lines."""
    pieces = [
        np.stack([points[:-1], points[1:]], axis=1) for lane in lanes if len(points := np.array(lane.points)) > 1
    ]
    return lifted(np.concatenate(pieces), ON_GROUND) if pieces else nothing()


def sides(row: Row) -> tuple[Points, Points]:
    """(2, 2) ends of the lines of plants to the left and the right of the alley."""
    ends = np.array([row.start, row.end], np.float64)
    along = ends[1] - ends[0]
    normal = np.array([-along[1], along[0]]) / max(math.hypot(along[0], along[1]), 1e-9)
    return ends + normal * row.width / 2.0, ends - normal * row.width / 2.0


def _plants(row: Row, spacing: float, first: float) -> list[Points]:
    """(N, 2) places every `spacing` m from `first` m on, one array per side."""
    length = math.dist(row.start, row.end)
    share = np.arange(first, length + 1e-6, max(spacing, 0.1))[:, None] / max(length, 1e-9)
    return [side[0] + share * (side[1] - side[0]) for side in sides(row)]


def uprights(places: list[Points], height: float) -> Floats:
    """(N, 2, 3) from the ground to `height` at (N, 2) places; every n-th of too many."""
    if not places:
        return nothing()
    ground = np.concatenate(places)
    ground = ground[:: math.ceil(len(ground) / MOST_UPRIGHTS) or 1]
    both = np.repeat(np.column_stack([ground, np.zeros(len(ground))])[:, None, :], 2, axis=1)
    both[:, 1, 2] = height
    return both.astype(np.float32)


def closed(points: Points) -> Floats:
    """(N, 2, 3) outline on the ground of an (N, 2) polygon."""
    return lifted(np.stack([points, np.roll(points, -1, axis=0)], axis=1), ON_GROUND)


def corners(warehouse: Warehouse) -> Points:
    """(4, 2) of a square around the parked robot."""
    cos, sin, half = math.cos(warehouse.yaw), math.sin(warehouse.yaw), WAREHOUSE_M / 2.0
    square = half * np.array([[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]])
    return np.asarray([warehouse.x, warehouse.y] + square @ np.array([[cos, sin], [-sin, cos]]), np.float64)


def lifted(segments: Points, z: float) -> Floats:
    """(N, 2, 2) to (N, 2, 3) at height `z`."""
    return np.concatenate([segments, np.full((*segments.shape[:2], 1), z)], axis=2).astype(np.float32)


def nothing() -> Floats:
    """No segments."""
    return np.zeros((0, 2, 3), np.float32)
