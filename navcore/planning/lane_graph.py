"""The road lanes as a graph: crossings and near ends are joined, and the shortest way is found."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import combinations, pairwise

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra

from navcore.maps.site_map import Lane, Point

# Places closer than this are one node, m.
_SAME = 0.01
# A lane recorded by GNSS has corners at every step; what strays less than this from straight is none, m.
_NOISE = 0.1


class LaneGraph:
    """Lanes, drivable both ways.

    Args:
        join: an end of a lane that comes this near to another lane is connected to it, m.
    """

    def __init__(self, lanes: tuple[Lane, ...], join: float) -> None:
        drawn = [(lane, _without_noise(lane)) for lane in lanes if len(lane.points) > 1]
        self._lanes = [lane for lane, line in drawn if line.length > _SAME]
        self._lines = [line for _, line in drawn if line.length > _SAME]
        self._nodes: list[Point] = []
        self._edges: dict[tuple[int, int], tuple[float, float]] = {}
        stations: list[set[float]] = [self._vertex_stations(line) for line in self._lines]
        links = [*self._crossings(), *self._near_joins(join)]
        for i, s, j, t in links:
            stations[i].add(s)
            stations[j].add(t)
        for lane, line, places in zip(self._lanes, self._lines, stations, strict=True):
            self._add_lane(line, sorted(places), lane.speed)
        for i, s, j, t in links:
            self._connect(self._node(self._at(i, s)), self._node(self._at(j, t)), self._lanes[i].speed)

    @property
    def empty(self) -> bool:
        """True without any lane."""
        return not self._lanes

    def nearest(self, x: float, y: float) -> Point:
        """Point of the lanes nearest to a place."""
        place = shapely.Point(x, y)
        line = min(self._lines, key=lambda candidate: candidate.distance(place))
        on = line.interpolate(line.project(place))
        return (on.x, on.y)

    def first_crossing(self, start: Point, end: Point) -> Point | None:
        """Point nearest to `start` at which the straight way to `end` meets a lane, None if it meets none."""
        way = shapely.LineString((start, end))
        hits = [p for line in self._lines for p in _points(way.intersection(line))]
        return min(hits, key=lambda p: math.dist(p, start)) if hits else None

    def route(self, start: Point, goal: Point) -> list[tuple[Point, float]] | None:
        """Shortest way between two points that lie on lanes: corners with the lane's speed on the way to each.

        None if the lanes do not connect them.
        """
        graph = _Extended(self, (start, goal))
        return graph.shortest()

    def _vertex_stations(self, line: shapely.LineString) -> set[float]:
        steps = shapely.get_coordinates(line)
        lengths = np.hypot(*np.diff(steps, axis=0).T)
        return {0.0, *np.cumsum(lengths).tolist()}

    def _at(self, lane: int, s: float) -> Point:
        point = self._lines[lane].interpolate(s)
        return (point.x, point.y)

    def _crossings(self) -> Iterator[tuple[int, float, int, float]]:
        for i, j in combinations(range(len(self._lines)), 2):
            a, b = self._lines[i], self._lines[j]
            for p in _points(a.intersection(b)):
                yield i, a.project(shapely.Point(p)), j, b.project(shapely.Point(p))

    def _near_joins(self, join: float) -> Iterator[tuple[int, float, int, float]]:
        for i, a in enumerate(self._lines):
            for j, b in enumerate(self._lines):
                for s in (0.0, a.length):
                    end = a.interpolate(s)
                    if i != j and _SAME < b.distance(end) <= join:
                        yield i, s, j, b.project(end)

    def _node(self, place: Point) -> int:
        for index, node in enumerate(self._nodes):
            if math.dist(node, place) < _SAME:
                return index
        self._nodes.append(place)
        return len(self._nodes) - 1

    def _connect(self, a: int, b: int, speed: float) -> None:
        if a != b:
            length = math.dist(self._nodes[a], self._nodes[b])
            self._edges[min(a, b), max(a, b)] = (length, speed)

    def _add_lane(self, line: shapely.LineString, stations: list[float], speed: float) -> None:
        points = [line.interpolate(s) for s in stations]
        nodes = [self._node((p.x, p.y)) for p in points]
        for a, b in pairwise(nodes):
            self._connect(a, b, speed)

    @property
    def nodes(self) -> list[Point]:
        """Places of the graph."""
        return list(self._nodes)

    @property
    def edges(self) -> dict[tuple[int, int], tuple[float, float]]:
        """Length (m) and speed (m/s) by pair of node indices."""
        return dict(self._edges)


class _Extended:
    """The graph with two more places spliced into the edges that they lie on."""

    def __init__(self, graph: LaneGraph, places: tuple[Point, Point]) -> None:
        self._nodes = graph.nodes
        self._edges = graph.edges
        self._ends = [self._splice(place) for place in places]

    def _splice(self, place: Point) -> int:
        spot = shapely.Point(place)
        for index, node in enumerate(self._nodes):
            if math.dist(node, place) < _SAME:
                return index
        a, b = min(
            self._edges, key=lambda e: shapely.LineString((self._nodes[e[0]], self._nodes[e[1]])).distance(spot)
        )
        _, speed = self._edges.pop((a, b))
        self._nodes.append(place)
        new = len(self._nodes) - 1
        for end in (a, b):
            self._edges[end, new] = (math.dist(self._nodes[end], place), speed)
        return new

    def shortest(self) -> list[tuple[Point, float]] | None:
        start, goal = self._ends
        rows, columns = zip(*self._edges, strict=True)
        lengths = [max(length, 1e-9) for length, _ in self._edges.values()]
        count = len(self._nodes)
        matrix = coo_array((lengths, (rows, columns)), shape=(count, count)).tocsr()
        distances, befores = dijkstra(matrix, directed=False, indices=[start], return_predecessors=True)
        distance, before = distances[0], befores[0]
        if not math.isfinite(distance[goal]):
            return None
        way = [goal]
        while way[-1] != start:
            way.append(int(before[way[-1]]))
        return self._with_speeds(way[::-1])

    def _with_speeds(self, way: list[int]) -> list[tuple[Point, float]]:
        speeds = [self._edges[(a, b) if (a, b) in self._edges else (b, a)][1] for a, b in pairwise(way)]
        return [(self._nodes[node], speed) for node, speed in zip(way, [*speeds[:1], *speeds] or [0.8], strict=True)]


def _without_noise(lane: Lane) -> shapely.LineString:
    return shapely.LineString(lane.points).simplify(_NOISE)


def _points(shape: shapely.Geometry) -> list[Point]:
    """Points of an intersection; of a shared stretch its ends."""
    return [(float(x), float(y)) for x, y in shapely.get_coordinates(shape)]
