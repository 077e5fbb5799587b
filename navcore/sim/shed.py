"""The warehouse building and where it stands."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.maps.site_map import Warehouse

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Shed:
    """The warehouse building: a box in `map`, m and rad; `x`, `y` is its middle, `length` runs along `yaw`."""

    x: float
    y: float
    yaw: float
    length: float = 12.0
    depth: float = 8.0
    height: float = 4.0


def placed_shed(warehouse: Warehouse | None, roads: Floats, lines: Floats) -> Shed | None:
    """The building beside the parked robot, at the first of back, left and right that is free of roads and plants.

    `roads` (R, 5) and `lines` (L, 4) as in `Orchard`.
    """
    if warehouse is None:
        return None
    for side in (math.pi, math.pi / 2, -math.pi / 2):
        bearing = warehouse.yaw + side
        away = 4.0 + 2.5
        shed = Shed(
            x=warehouse.x + away * math.cos(bearing), y=warehouse.y + away * math.sin(bearing),
            yaw=bearing + math.pi / 2,
        )  # fmt: skip
        if _clear(shed, roads[:, :4], 1.0 + roads[:, 4]) and _clear(shed, lines, np.full(len(lines), 1.5)):
            return shed
    return None


def _clear(shed: Shed, segments: Floats, margin: Floats) -> bool:
    """Whether no segment (N, 4) comes closer to the shed's walls than its margin (N,)."""
    t = np.linspace(0.0, 1.0, 200)[:, None]
    c, s = math.cos(shed.yaw), math.sin(shed.yaw)
    dx = segments[:, 0] + t * (segments[:, 2] - segments[:, 0]) - shed.x
    dy = segments[:, 1] + t * (segments[:, 3] - segments[:, 1]) - shed.y
    outside_x = np.maximum(np.abs(dx * c + dy * s) - shed.length / 2, 0.0)
    outside_y = np.maximum(np.abs(dy * c - dx * s) - shed.depth / 2, 0.0)
    return bool(np.all(np.hypot(outside_x, outside_y) >= margin))
