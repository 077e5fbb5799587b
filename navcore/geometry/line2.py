"""Straight lines of the plane as unit normal and offset, so that no direction is special."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.geometry.se2 import SE2

Floats = NDArray[np.float64]

# Below this sine two directions count as parallel (0.006 deg).
_PARALLEL = 1e-4


@dataclass(frozen=True, slots=True)
class Line2:
    """The points p with n . p = offset, directed so that the unit normal n = (nx, ny) points to its left.

    "Left" is meant for x right, y up. In the image (u right, v down) the same formulas hold and the normal points
    to the right hand of the direction as seen on the screen.
    """

    nx: float
    ny: float
    offset: float

    @staticmethod
    def through(p: tuple[float, float], q: tuple[float, float]) -> Line2:
        """The line from `p` towards `q`. Raises InputError if they coincide."""
        dx, dy = q[0] - p[0], q[1] - p[1]
        norm = math.hypot(dx, dy)
        if not norm > 0.0:
            raise InputError("A line needs two different, finite points.")
        return Line2.along(p, math.atan2(dy, dx))

    @staticmethod
    def along(point: tuple[float, float], heading: float) -> Line2:
        """The line through `point` in direction `heading` (rad)."""
        nx, ny = -math.sin(heading), math.cos(heading)
        return Line2(nx, ny, nx * point[0] + ny * point[1])

    @staticmethod
    def fit(points: Floats, weights: Floats | None = None) -> Line2:
        """Total least squares through points (N, 2), N >= 2, directed from the first towards the last point.

        Smallest eigenvector of the scatter matrix, so vertical lines are as good as any. Raises InputError when the
        points do not span a line.
        """
        p = np.asarray(points, dtype=np.float64)
        w = np.ones(len(p)) if weights is None else np.asarray(weights, dtype=np.float64)
        if len(p) < 2 or not np.isfinite(p).all() or not w.sum() > 0.0:
            raise InputError("A line fit needs at least two finite points with positive weight.")
        centre = w @ p / w.sum()
        values, vectors = np.linalg.eigh((p - centre).T * w @ (p - centre))
        if not values[1] > 0.0:
            raise InputError("A line fit needs two different points.")
        direction = vectors[:, 1] if vectors[:, 1] @ (p[-1] - p[0]) >= 0.0 else -vectors[:, 1]
        return Line2.along((float(centre[0]), float(centre[1])), math.atan2(direction[1], direction[0]))

    @property
    def heading(self) -> float:
        """Direction of the line, rad."""
        return math.atan2(-self.nx, self.ny)

    @property
    def foot(self) -> tuple[float, float]:
        """The line's point nearest to the origin."""
        return self.offset * self.nx, self.offset * self.ny

    def distance(self, x: float, y: float) -> float:
        """Signed distance of a point, positive on the normal's side."""
        return self.nx * x + self.ny * y - self.offset

    def distances(self, points: Floats) -> Floats:
        """Signed distances (N,) of points (N, 2)."""
        p = np.asarray(points, dtype=np.float64)
        return np.asarray(p @ (self.nx, self.ny) - self.offset)

    def project(self, x: float, y: float) -> tuple[float, float]:
        """The line's point nearest to (x, y)."""
        d = self.distance(x, y)
        return x - d * self.nx, y - d * self.ny

    def reversed(self) -> Line2:
        """The same points, the other direction."""
        return Line2(-self.nx, -self.ny, -self.offset)

    def transformed(self, T_target_source: SE2) -> Line2:
        """The same line in the target frame."""
        return Line2.along(T_target_source.apply_point(*self.foot), self.heading + T_target_source.yaw)

    def intersection(self, other: Line2) -> tuple[float, float] | None:
        """The common point, None if the lines are parallel within 0.006 deg."""
        det = self.nx * other.ny - self.ny * other.nx
        if abs(det) < _PARALLEL:
            return None
        x = (self.offset * other.ny - other.offset * self.ny) / det
        y = (self.nx * other.offset - other.nx * self.offset) / det
        return x, y

    def x_at(self, y: float) -> float | None:
        """x of the line's point at height `y`, None if the line is horizontal."""
        return None if abs(self.nx) < _PARALLEL else (self.offset - self.ny * y) / self.nx

    def y_at(self, x: float) -> float | None:
        """y of the line's point at `x`, None if the line is vertical."""
        return None if abs(self.ny) < _PARALLEL else (self.offset - self.nx * x) / self.ny


def bisector(a: Line2, b: Line2) -> Line2 | None:
    """The line with equal signed distance to `a` and to the mirrored `b`: the centre line between two row sides.

    Both lines are directed the same way (their directions differ by less than 90 deg). Parallel lines give the line
    halfway between; the sum of the normals never needs the point of intersection, so nothing is singular. None if
    the directions are opposed.
    """
    nx, ny = a.nx + b.nx, a.ny + b.ny
    norm = math.hypot(nx, ny)
    if norm < 1.0:
        return None
    return Line2(nx / norm, ny / norm, (a.offset + b.offset) / norm)
