"""Pieces of made-up farms: blocks of rows, headlands, bent roads."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Point, Row, Zone, ZoneKind

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """Parallel rows side by side, sharing their lines of plants.

    Attributes:
        T_map_block: frame of the block: x across the rows, y along them, origin on the first row's start.
        name: prefix of the rows' names.
        rows: how many. length, width: of each row, m.
        first: number of the first row.
    """

    T_map_block: SE2
    name: str
    rows: int
    length: float
    width: float
    first: int = 1
    post_spacing: float = 6.0
    plant_spacing: float = 1.5

    def site_rows(self) -> tuple[Row, ...]:
        """The rows, each driven away from the first headland from `start` to `end`."""
        return tuple(self._row(i) for i in range(self.rows))

    def _row(self, i: int) -> Row:
        across, number = i * self.width, self.first + i
        return Row(
            id=f"row-{number}", name=f"{self.name}{i + 1}", width=self.width, speed=0.6,
            start=self.place(across, 0.0), end=self.place(across, self.length),
            post_spacing=self.post_spacing, plant_spacing=self.plant_spacing,
        )  # fmt: skip

    def place(self, across: float, along: float) -> Point:
        """Point in `map`."""
        x, y = self.T_map_block.apply_point(across, along)
        return round(x, 3), round(y, 3)

    def area(self, left: float, right: float, low: float, high: float) -> tuple[Point, ...]:
        """Corners in `map` of a box in the block's frame."""
        corners = ((left, low), (right, low), (right, high), (left, high))
        return tuple(self.place(a, b) for a, b in corners)


def headland(block: Block, number: int, left: float, right: float, low: float, high: float) -> Zone:
    """Ground to turn on, a box in the block's frame."""
    return Zone(
        id=f"headland-{number}",
        kind=ZoneKind.HEADLAND,
        polygon=block.area(left, right, low, high),
        name=f"Headland {number}",
    )


def bent_road(corners: Iterable[Point], step: float = 3.0) -> tuple[Point, ...]:
    """A road that rounds its corners: Chaikin's corner cutting, three times, then a waypoint about every `step` m."""
    points = np.array(list(corners), dtype=np.float64)
    for _ in range(3):
        inner = [p for a, b in itertools.pairwise(points) for p in (0.75 * a + 0.25 * b, 0.25 * a + 0.75 * b)]
        points = np.vstack((points[:1], inner, points[-1:]))
    return _spaced(points, step)


def _spaced(points: Floats, step: float) -> tuple[Point, ...]:
    lengths = np.concatenate(((0.0,), np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
    count = max(math.ceil(lengths[-1] / step), 1)
    stations = np.linspace(0.0, lengths[-1], count + 1)
    xs, ys = np.interp(stations, lengths, points[:, 0]), np.interp(stations, lengths, points[:, 1])
    return tuple((round(float(x), 3), round(float(y), 3)) for x, y in zip(xs, ys, strict=True))
