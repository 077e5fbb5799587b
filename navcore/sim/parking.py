"""Where the simulated robot stands at first."""

from __future__ import annotations

import math

import numpy as np

from navcore.errors import InputError
from navcore.maps.site_map import SiteMap

Pose = tuple[float, float, float]


def parked(site: SiteMap, start: Pose | None, std_m: float, std_deg: float, rng: np.random.Generator) -> Pose:
    """`start` (x, y, yaw) if there is one, else at the warehouse, not quite as drawn (1-sigma)."""
    if start is not None:
        return start
    if site.warehouse is None:
        raise InputError("Draw the warehouse first: without one the simulated robot has no place to stand.")
    dx, dy, turn = rng.standard_normal(3)
    w = site.warehouse
    return float(w.x + std_m * dx), float(w.y + std_m * dy), float(w.yaw + math.radians(std_deg) * turn)
