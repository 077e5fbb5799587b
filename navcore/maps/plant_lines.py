"""Surveyed lines of plants, and the drivable rows between them."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.line2 import Line2, bisector
from navcore.maps.site_map import Point, Row

Floats = NDArray[np.float64]

# Alleys wider than this are no rows but gaps between blocks, m.
_WIDEST = 12.0


@dataclass(frozen=True, slots=True)
class PlantLine:
    """One line of posts or trunks.

    Attributes:
        points: (N, 2) in `map`, in order along `line`.
    """

    name: str
    line: Line2
    points: Floats


def robust_line(points: Floats) -> Line2:
    """Line through points (N, 2), N >= 2, that a minority of wrong points does not move: least median of distances,
    then least squares on those within three medians (at least 5 cm).
    """
    pairs = combinations(range(len(points)), 2)
    candidates = [Line2.through(tuple(points[i]), tuple(points[j])) for i, j in pairs if _apart(points, i, j)]
    if not candidates:
        return Line2.fit(points)
    best = min(candidates, key=lambda line: float(np.median(np.abs(line.distances(points)))))
    off = np.abs(best.distances(points))
    return Line2.fit(points[off <= max(3.0 * float(np.median(off)), 0.05)])


def _apart(points: Floats, i: int, j: int) -> bool:
    return math.dist(points[i], points[j]) > 0.5


def along(line: Line2, points: Floats) -> Floats:
    """Coordinates (N,) of points along a line."""
    return np.asarray(points @ (line.ny, -line.nx))


def alleys(lines: list[PlantLine], plant_spacing: float | None) -> tuple[Row, ...]:
    """Drivable rows: the alley between each two neighbouring lines, all directed the same way."""
    if len(lines) < 2:
        return ()
    first = lines[0].line
    directed = [_directed(line, first) for line in lines]
    middle = np.mean([line.points.mean(axis=0) for line in directed], axis=0)
    across = sorted(directed, key=lambda item: float(first.distance(*item.line.project(*middle))))
    if across[0].name > across[-1].name:
        across.reverse()
    rows = [_alley(a, b, plant_spacing) for a, b in pairwise(across)]
    return tuple(row for row in rows if row is not None and row.width <= _WIDEST)


def _directed(item: PlantLine, like: Line2) -> PlantLine:
    same = item.line.nx * like.nx + item.line.ny * like.ny >= 0.0
    return item if same else PlantLine(item.name, item.line.reversed(), item.points[::-1])


def _alley(a: PlantLine, b: PlantLine, plant_spacing: float | None) -> Row | None:
    centre = bisector(a.line, b.line)
    if centre is None:
        return None
    start, end = (_between(centre, tuple(a.points[k]), tuple(b.points[k])) for k in (0, -1))
    middle = ((start[0] + end[0]) / 2, (start[1] + end[1]) / 2)
    return Row(
        id=f"{a.name}-{b.name}", start=start, end=end, name=f"{a.name} / {b.name}",
        width=round(float(abs(a.line.distance(*middle)) + abs(b.line.distance(*middle))), 3),
        post_spacing=round(_spacing(a, b), 2), plant_spacing=plant_spacing or 1.5,
    )  # fmt: skip


def _between(centre: Line2, p: Point, q: Point) -> Point:
    x, y = centre.project((p[0] + q[0]) / 2, (p[1] + q[1]) / 2)
    return round(float(x), 6), round(float(y), 6)


def _spacing(a: PlantLine, b: PlantLine) -> float:
    gaps = np.concatenate([np.abs(np.diff(along(item.line, item.points))) for item in (a, b)])
    return max(float(np.median(gaps)), 0.2) if len(gaps) else 6.0
