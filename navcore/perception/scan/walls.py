"""Straight walls and fences in a scan: its runs of neighbours, split at their corners, each through its points."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
MM = 1000.0


@dataclass(frozen=True, slots=True, kw_only=True)
class WallParams:
    """Attributes:
    gap, gap_share: neighbours further apart than that, m, and than that share of their distance are not of one run.
    corner: a run that leaves its chord by more has a corner there, m (Douglas and Peucker, 1973).
    shortest, fewest: of a wall, m and points.
    straight: points scatter about a wall by no more, RMS in m.
    """

    gap: float = 0.2
    gap_share: float = 0.15
    corner: float = 0.05
    shortest: float = 0.5
    fewest: int = 8
    straight: float = 0.02


@dataclass(frozen=True, slots=True, kw_only=True)
class Wall:
    """Attributes:
    ends: (x, y) of both, m, in the sensor's plane. points: that it goes through. rms: by so much they scatter, m.
    """

    ends: tuple[tuple[float, float], tuple[float, float]]
    points: int
    rms: float

    @property
    def length(self) -> float:
        """m."""
        return math.dist(*self.ends)


def walls(angles: Floats, distances: Floats, params: WallParams = WallParams()) -> tuple[Wall, ...]:
    """Of one turn: bearings (N,) rad and distances (N,) m, 0 where nothing came back. The longest comes first."""
    back = np.flatnonzero(distances > 0.0)
    order = back[np.argsort(np.mod(angles[back], math.tau), kind="stable")]
    xy = distances[order, None] * np.column_stack((np.cos(angles[order]), np.sin(angles[order])))
    stretches = [part for run in _runs(xy, distances[order], params) for part in _straight(run, params.corner)]
    found = [_wall(part) for part in stretches if len(part) >= max(params.fewest, 2)]
    kept = [wall for wall in found if wall.length >= params.shortest and wall.rms <= params.straight]
    return tuple(sorted(kept, key=lambda wall: -wall.length))


def _runs(xy: Floats, distances: Floats, params: WallParams) -> list[Floats]:
    """Neighbours (N, 2) that belong together; the turn's last ray is a neighbour of its first."""
    if not len(xy):
        return []
    apart = np.hypot(*(xy - np.roll(xy, 1, axis=0)).T)
    begins = np.flatnonzero(apart > np.maximum(params.gap, params.gap_share * distances))
    return _halves(xy) if not len(begins) else np.split(np.roll(xy, -begins[0], axis=0), begins[1:] - begins[0])


def _halves(ring: Floats) -> list[Floats]:
    """Of a run all around, (N, 2): from its corner furthest out to the one furthest from that, and back."""
    ring = np.roll(ring, -int(np.argmax(np.hypot(*(ring - ring.mean(axis=0)).T))), axis=0)
    opposite = int(np.argmax(np.hypot(*(ring - ring[0]).T)))
    return [ring[: opposite + 1], np.vstack((ring[opposite:], ring[:1]))]


def _straight(run: Floats, corner: float) -> list[Floats]:
    """Stretches between the corners of a run (N, 2)."""
    whole = np.round(run * MM).astype(np.int32)
    corners = cv2.approxPolyDP(whole[:, None], corner * MM, closed=False)[:, 0]
    places, begin = [], 0
    for place in corners:
        begin += int(np.argmax((whole[begin:] == place).all(axis=1)))
        places.append(begin)
    return [run[a : b + 1] for a, b in pairwise(places)]


def _wall(points: Floats) -> Wall:
    """The line of least squares through (N, 2), as long as they reach."""
    middle = points.mean(axis=0)
    _, sizes, axes = np.linalg.svd(points - middle, full_matrices=False)
    along = (points - middle) @ axes[0]
    first, last = (tuple((middle + t * axes[0]).tolist()) for t in (along.min(), along.max()))
    rms = float(sizes[1]) / math.sqrt(len(points))
    return Wall(ends=((first[0], first[1]), (last[0], last[1])), points=len(points), rms=rms)
