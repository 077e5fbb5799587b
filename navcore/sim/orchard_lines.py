"""Lines of plants: where posts and trunks stand, from the rows of a site or from its survey."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from navcore.maps.site_map import Plant, Row, SiteMap

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlantLine:
    """A straight line of plants in `map`, m.

    Attributes:
        x0, y0, x1, y1: its ends.
        rows: ids of the rows (alleys) it borders.
        reach: half the width of the widest alley it borders, m.
        post_spacing, plant_spacing: along the line, m.
        surveyed: the surveyed plants that stand on it.
    """

    x0: float
    y0: float
    x1: float
    y1: float
    rows: tuple[str, ...]
    reach: float
    post_spacing: float
    plant_spacing: float
    surveyed: tuple[Plant, ...] = ()

    @property
    def length(self) -> float:
        """Distance between the ends, m."""
        return math.hypot(self.x1 - self.x0, self.y1 - self.y0)

    @property
    def direction(self) -> tuple[float, float]:
        """Unit vector from the first end to the second."""
        return (self.x1 - self.x0) / self.length, (self.y1 - self.y0) / self.length

    def frame(self, points: Floats) -> Floats:
        """Points (N, 2) as (along, left of the line), m, shape (N, 2)."""
        cx, sx = self.direction
        d = np.asarray(points, dtype=np.float64) - (self.x0, self.y0)
        return np.column_stack((d[:, 0] * cx + d[:, 1] * sx, d[:, 1] * cx - d[:, 0] * sx))

    def place(self, along: Floats, left: Floats) -> Floats:
        """Points (N, 2) in `map` of positions along and left of the line, m."""
        cx, sx = self.direction
        return np.column_stack((self.x0 + along * cx - left * sx, self.y0 + along * sx + left * cx))


def plant_lines(site: SiteMap, merge_distance_m: float) -> tuple[PlantLine, ...]:
    """The site's lines of plants.

    Every row has a line at either side. Lines of neighbouring rows closer than `merge_distance_m` are one line. A
    line on which at least two surveyed plants stand is moved to where the survey has it.
    """
    merged: list[PlantLine] = []
    for row in site.rows:
        for line in _sides(row):
            _merge_into(merged, line, merge_distance_m)
    return _surveyed(merged, site.plants, merge_distance_m)


def _sides(row: Row) -> tuple[PlantLine, ...]:
    (x0, y0), (x1, y1) = row.start, row.end
    length = math.hypot(x1 - x0, y1 - y0)
    if length < 0.5:
        return ()
    nx, ny = -(y1 - y0) / length * row.width / 2, (x1 - x0) / length * row.width / 2
    return tuple(
        PlantLine(
            x0=x0 + s * nx, y0=y0 + s * ny, x1=x1 + s * nx, y1=y1 + s * ny, rows=(row.id,), reach=row.width / 2,
            post_spacing=row.post_spacing, plant_spacing=row.plant_spacing,
        )
        for s in (1.0, -1.0)
    )  # fmt: skip


def _merge_into(lines: list[PlantLine], line: PlantLine, distance_m: float) -> None:
    for i, other in enumerate(lines):
        if _coincide(other, line, distance_m):
            lines[i] = _union(other, line)
            return
    lines.append(line)


def _coincide(a: PlantLine, b: PlantLine, distance_m: float) -> bool:
    if set(a.rows) & set(b.rows):
        return False
    ends = a.frame(np.array([(b.x0, b.y0), (b.x1, b.y1)]))
    overlap = min(ends[:, 0].max(), a.length) - max(ends[:, 0].min(), 0.0)
    return bool(overlap > 0.5 * min(a.length, b.length) and np.abs(ends[:, 1]).max() < distance_m)


def _union(a: PlantLine, b: PlantLine) -> PlantLine:
    """One line with the mean position of both and the extent of the two together."""
    ends = a.frame(np.array([(b.x0, b.y0), (b.x1, b.y1)]))
    first, last = ends[np.argmin(ends[:, 0])], ends[np.argmax(ends[:, 0])]
    along = np.array([min(0.0, first[0]), max(a.length, last[0])])
    (x0, y0), (x1, y1) = a.place(along, np.array([first[1], last[1]]) / 2)
    return replace(a, x0=x0, y0=y0, x1=x1, y1=y1, rows=(*a.rows, *b.rows), reach=max(a.reach, b.reach))


def _surveyed(lines: list[PlantLine], plants: tuple[Plant, ...], distance_m: float) -> tuple[PlantLine, ...]:
    if not plants or not lines:
        return tuple(lines)
    owner = _owners(lines, plants, distance_m)
    return tuple(
        _fitted(line, tuple(p for p, o in zip(plants, owner, strict=True) if o == i)) for i, line in enumerate(lines)
    )


def _owners(lines: list[PlantLine], plants: tuple[Plant, ...], distance_m: float) -> NDArray[np.intp]:
    """Index of the line each plant stands on, -1 for a plant that stands alone; shape (N,)."""
    points = np.array([(p.x, p.y) for p in plants])
    frames = np.stack([line.frame(points) for line in lines])
    beyond = np.array([line.length for line in lines])[:, None]
    outside = np.maximum(np.maximum(-frames[:, :, 0], frames[:, :, 0] - beyond), 0.0)
    away = np.hypot(np.maximum(outside - distance_m, 0.0), frames[:, :, 1])
    nearest = away.argmin(axis=0)
    return np.where(away.min(axis=0) < distance_m, nearest, -1)


def _fitted(line: PlantLine, plants: tuple[Plant, ...]) -> PlantLine:
    """The line through its surveyed plants (total least squares), as long as the survey."""
    points = np.array([(p.x, p.y) for p in plants]).reshape(-1, 2)
    if len(points) < 2 or np.ptp(line.frame(points)[:, 0]) < 1.0:
        return replace(line, surveyed=plants)
    mean = points.mean(axis=0)
    axis = np.linalg.svd(points - mean)[2][0]
    axis = axis if axis @ line.direction > 0 else -axis
    along = (points - mean) @ axis
    (x0, y0), (x1, y1) = mean + along.min() * axis, mean + along.max() * axis
    return replace(line, x0=float(x0), y0=float(y0), x1=float(x1), y1=float(y1), surveyed=plants)
