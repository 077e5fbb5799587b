"""A way round the rows and keep-out zones where no lane leads: shortest path in a visibility graph."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import shapely
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from navcore.maps.site_map import Point
from navcore.planning.free_space import FreeSpace

Floats = NDArray[np.float64]

# Corners are passed at this distance, and nothing is passed nearer than the other, m.
_ROUND = 2.2
_CLEAR = 1.0
# Obstacles nearer to each other than this are one block, m; if there are too many blocks, than the next.
_GAPS = (3.0, 6.0, 12.0, 24.0, 48.0)
# With more corners than this the ways between them take seconds.
_MOST_CORNERS = 250


def detour(space: FreeSpace, start: Point, goal: Point) -> list[Point] | None:
    """Corners of the shortest way from `start` to `goal` between obstacles, ends left out; None if none."""
    blocks, corners = _blocks_and_corners(space)
    forbidden = blocks.buffer(_CLEAR)
    shapely.prepare(forbidden)
    places = [start, goal, *corners]
    pairs = list(combinations(range(len(places)), 2))
    ways = shapely.linestrings([[places[i], places[j]] for i, j in pairs])
    free = ~shapely.intersects(forbidden, ways)
    if not space.keep_in.is_empty:
        free &= shapely.covers(space.keep_in, ways)
    rows, columns = np.array(pairs)[free].T if free.any() else (np.empty(0, int), np.empty(0, int))
    lengths = shapely.length(ways[free])
    graph = coo_array((lengths, (rows, columns)), shape=(len(places), len(places))).tocsr()
    distances, before = dijkstra(graph, directed=False, indices=[0], return_predecessors=True)
    return _traced(places, before[0]) if math.isfinite(distances[0][1]) else None


def _blocks_and_corners(space: FreeSpace) -> tuple[shapely.Geometry, list[Point]]:
    """Rows side by side as closed blocks, and the keep-out zones, with the places round them."""
    solid = shapely.union_all([space.alleys, space.plants])
    for gap in _GAPS:
        blocks = shapely.union_all([solid.buffer(gap / 2).buffer(-gap / 2), solid, space.keep_out])
        corners = _corners(blocks, space)
        if len(corners) <= _MOST_CORNERS:
            break
    return blocks, corners[:_MOST_CORNERS]


def _corners(blocks: shapely.Geometry, space: FreeSpace) -> list[Point]:
    """Places round the outside of each block."""
    round_blocks = [
        shapely.convex_hull(part).buffer(_ROUND, join_style="mitre") for part in shapely.get_parts(blocks)
    ]
    corners = [c for block in round_blocks for c in shapely.get_coordinates(block.simplify(0.5))[:-1].tolist()]
    inside = [c for c in corners if space.keep_in.is_empty or space.keep_in.covers(shapely.Point(c))]
    return [(x, y) for x, y in inside]


def _traced(places: list[Point], before: NDArray[np.int32]) -> list[Point]:
    way, node = [], int(before[1])
    while node > 0:
        way.append(places[node])
        node = int(before[node])
    return way[::-1]
