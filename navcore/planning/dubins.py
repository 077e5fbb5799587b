"""Shortest forward paths of bounded curvature between two poses.

L. E. Dubins, "On curves of minimal length with a constraint on average curvature", Am. J. Math. 79 (1957); formulas
after A. M. Shkel and V. Lumelsky, "Classification of the Dubins set", Robotics and Autonomous Systems 34 (2001).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2

Floats = NDArray[np.float64]
_TURN = 2.0 * math.pi
_SIDE = {"L": 1.0, "S": 0.0, "R": -1.0}
# A full circle less this is rounding noise, rad.
_NOISE = 1e-7


@dataclass(frozen=True, slots=True)
class DubinsPath:
    """Three parts, each a left arc, a right arc or a straight, with their lengths in m."""

    start: SE2
    radius: float
    word: str
    lengths: tuple[float, float, float]

    @property
    def length(self) -> float:
        """m."""
        return sum(self.lengths)

    def poses(self, step: float) -> Floats:
        """(N, 3) poses x, y, yaw along the path, at most `step` m apart, both ends included."""
        poses, pose = [self.start], self.start
        for side, length in zip(self.word, self.lengths, strict=True):
            count = math.ceil(length / step - 1e-6)
            curvature = _SIDE[side] / self.radius
            for k in range(1, count + 1):
                way = length * k / count
                poses.append(pose @ SE2.arc(way, way * curvature))
            pose = pose @ SE2.arc(length, length * curvature)
        return np.array([(p.x, p.y, p.yaw) for p in poses], dtype=np.float64)


def dubins_paths(start: SE2, goal: SE2, radius: float) -> list[DubinsPath]:
    """All Dubins paths from `start` to `goal`, shortest first."""
    local = start.inverse() @ goal
    d = math.hypot(local.x, local.y) / radius
    theta = math.atan2(local.y, local.x)
    alpha, beta = -theta % _TURN, (local.yaw - theta) % _TURN
    paths = [
        DubinsPath(start, radius, word, (t * radius, p * radius, q * radius))
        for word, (t, p, q) in _words(alpha, beta, d)
    ]
    return sorted(paths, key=lambda path: path.length)


def _words(a: float, b: float, d: float) -> Iterator[tuple[str, tuple[float, float, float]]]:
    yield from _same_side(a, b, d)
    yield from _other_side(a, b, d)
    yield from _three_arcs(a, b, d)


def _same_side(a: float, b: float, d: float) -> Iterator[tuple[str, tuple[float, float, float]]]:
    squared = 2 + d * d - 2 * math.cos(a - b) + 2 * d * (math.sin(a) - math.sin(b))
    if squared >= 0.0:
        turn = math.atan2(math.cos(b) - math.cos(a), d + math.sin(a) - math.sin(b))
        yield "LSL", (_arc(turn - a), math.sqrt(squared), _arc(b - turn))
    squared = 2 + d * d - 2 * math.cos(a - b) + 2 * d * (math.sin(b) - math.sin(a))
    if squared >= 0.0:
        turn = math.atan2(math.cos(a) - math.cos(b), d - math.sin(a) + math.sin(b))
        yield "RSR", (_arc(a - turn), math.sqrt(squared), _arc(turn - b))


def _other_side(a: float, b: float, d: float) -> Iterator[tuple[str, tuple[float, float, float]]]:
    squared = -2 + d * d + 2 * math.cos(a - b) + 2 * d * (math.sin(a) + math.sin(b))
    if squared >= 0.0:
        p = math.sqrt(squared)
        turn = math.atan2(-math.cos(a) - math.cos(b), d + math.sin(a) + math.sin(b)) - math.atan2(-2.0, p)
        yield "LSR", (_arc(turn - a), p, _arc(turn - b))
    squared = -2 + d * d + 2 * math.cos(a - b) - 2 * d * (math.sin(a) + math.sin(b))
    if squared >= 0.0:
        p = math.sqrt(squared)
        turn = math.atan2(math.cos(a) + math.cos(b), d - math.sin(a) - math.sin(b)) - math.atan2(2.0, p)
        yield "RSL", (_arc(a - turn), p, _arc(b - turn))


def _three_arcs(a: float, b: float, d: float) -> Iterator[tuple[str, tuple[float, float, float]]]:
    cosine = (6 - d * d + 2 * math.cos(a - b) + 2 * d * (math.sin(a) - math.sin(b))) / 8
    if abs(cosine) <= 1.0:
        p = _TURN - math.acos(cosine)
        t = _arc(a - math.atan2(math.cos(a) - math.cos(b), d - math.sin(a) + math.sin(b)) + p / 2)
        yield "RLR", (t, p, _arc(a - b - t + p))
    cosine = (6 - d * d + 2 * math.cos(a - b) + 2 * d * (math.sin(b) - math.sin(a))) / 8
    if abs(cosine) <= 1.0:
        p = _TURN - math.acos(cosine)
        t = _arc(-a - math.atan2(math.cos(a) - math.cos(b), d + math.sin(a) - math.sin(b)) + p / 2)
        yield "LRL", (t, p, _arc(b - a - t + p))


def _arc(angle: float) -> float:
    wrapped = angle % _TURN
    return 0.0 if _TURN - wrapped < _NOISE else wrapped
