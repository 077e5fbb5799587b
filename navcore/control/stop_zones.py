"""Zones that the robot must not leave or enter: slow before them, stop inside the margin."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from navcore.control.speed_regulation import SpeedLimit, SpeedRegulationParams, braking_speed
from navcore.errors import InputError, NotFiniteError
from navcore.geometry.se2 import SE2

Floats = NDArray[np.float64]
Polygon = Sequence[tuple[float, float]]
_CLEAR = SpeedLimit(speed=math.inf, reason="clear of zone edges")


@dataclass(frozen=True, slots=True, kw_only=True)
class StopZoneParams:
    """Attributes:
    margin: m that stay free between body and zone edge.
    sigmas: how many 1-sigma of the position are added to the margin.
    step: m between the poses at which the swept body is tested; below half the body's width.
    least_sweep, most_sweep: m of motion looked at.
    """

    margin: float = 0.10
    sigmas: float = 2.0
    step: float = 0.10
    least_sweep: float = 0.5
    most_sweep: float = 4.0


class StopZones:
    """Keep-in and keep-out polygons, prepared once; asked every tick. All in `map`.

    The robot may be wherever some keep-in polygon covers the ground (anywhere, if there is none) and no keep-out
    polygon does.

    Args:
        length, width: of the body, m, centred on the driving frame.

    Raises InputError for a polygon of fewer than three points, NotFiniteError for coordinates that are no numbers.
    """

    def __init__(
        self, keep_in: Iterable[Polygon], keep_out: Iterable[Polygon], *, length: float, width: float,
        params: StopZoneParams = StopZoneParams(), regulation: SpeedRegulationParams = SpeedRegulationParams(),
    ) -> None:  # fmt: skip
        self._keep_in = _outline([_checked(p) for p in keep_in])
        self._keep_out = _outline([_checked(p) for p in keep_out])
        self._edges = np.vstack((self._keep_in, self._keep_out))
        # Middle and radius of a circle without an edge, on the right side.
        self._clear = (0.0, 0.0, 0.0)
        self._half = (length / 2, width / 2)
        self._params, self._regulation = params, regulation

    def limit(self, T_map_driving: SE2, *, v: float, curvature: float, std: float = 0.0) -> SpeedLimit:
        """Speed from which the robot still stops before its swept body, widened by the margin, meets an edge.

        Args:
            v: speed now, m/s; curvature: of the motion commanded, 1/m; std: 1-sigma of the position, m.
        """
        margin = self._params.margin + self._params.sigmas * std
        if self._still_clear(T_map_driving, self._reach(v) + math.hypot(*self._half) + margin):
            return _CLEAR
        wrong_side = self._wrong_side(T_map_driving.x, T_map_driving.y)
        if wrong_side is not None:
            return SpeedLimit(speed=0.0, reason=wrong_side)
        self._clear = (T_map_driving.x, T_map_driving.y, _to_nearest(self._edges, T_map_driving.x, T_map_driving.y))
        distance, what = self._free_way(self._swept(T_map_driving, v, curvature), margin)
        if distance is None:
            return _CLEAR
        return SpeedLimit(
            speed=braking_speed(distance, 0.0, self._regulation), reason=f"{what} {distance:.1f} m ahead"
        )

    def _still_clear(self, T_map_driving: SE2, needed: float) -> bool:
        """No edge within `needed` m, as far as the last look at all of them tells: most ticks need no other."""
        x, y, radius = self._clear
        return math.hypot(T_map_driving.x - x, T_map_driving.y - y) + needed < radius

    def _reach(self, v: float) -> float:
        """Way looked at: over reaction and braking and a little more, m."""
        p, r = self._params, self._regulation
        way = abs(v) * r.reaction + v * v / (2.0 * r.braking) + p.least_sweep
        return min(way, p.most_sweep) + p.step

    def _wrong_side(self, x: float, y: float) -> str | None:
        if len(self._keep_in) and not _contains(self._keep_in, x, y):
            return "outside the keep-in zone: stop"
        if _contains(self._keep_out, x, y):
            return "inside a keep-out zone: stop"
        return None

    def _swept(self, T_map_driving: SE2, v: float, curvature: float) -> Floats:
        """Poses (N, 3) along the arc that is being driven."""
        ways = np.arange(0.0, self._reach(v), self._params.step)
        poses = [T_map_driving @ SE2.arc(float(way), float(way) * curvature) for way in ways]
        return np.array([(q.x, q.y, q.yaw) for q in poses], dtype=np.float64)

    def _free_way(self, poses: Floats, margin: float) -> tuple[float | None, str]:
        """Way until the widened body first meets an edge, None if it does not; and what it meets."""
        leaves = self._first_hit(self._keep_in, poses, margin)
        enters = self._first_hit(self._keep_out, poses, margin)
        if leaves is not None and (enters is None or leaves <= enters):
            return leaves, "edge of the keep-in zone"
        return enters, "keep-out zone"

    def _first_hit(self, edges: Floats, poses: Floats, margin: float) -> float | None:
        near = _near(edges, poses, math.hypot(*self._half) + margin)
        if not len(near):
            return None
        hits = _rectangle_meets(near, poses, self._half[0] + margin, self._half[1] + margin)
        return max(float(np.argmax(hits)) * self._params.step - self._params.step, 0.0) if hits.any() else None


def _checked(polygon: Polygon) -> Floats:
    p = np.array(polygon, dtype=np.float64)
    if p.ndim != 2 or p.shape[0] < 3 or p.shape[1] != 2:
        raise InputError("A zone needs at least three (x, y) corners.")
    if not np.isfinite(p).all():
        raise NotFiniteError("A zone's corners must be finite numbers.")
    return p


def _outline(polygons: list[Floats]) -> Floats:
    """Edges (E, 4) as x0, y0, x1, y1 round all that the polygons cover together; where they overlap is no edge."""
    if not polygons:
        return np.empty((0, 4))
    area = shapely.union_all(shapely.make_valid([shapely.Polygon(p) for p in polygons]))
    rings = [r for part in shapely.get_parts(area) if part.area > 0 for r in (part.exterior, *part.interiors)]
    return np.vstack([np.hstack((c[:-1], c[1:])) for c in (np.asarray(r.coords) for r in rings)])


def _contains(edges: Floats, x: float, y: float) -> bool:
    """Even-odd rule."""
    x0, y0, x1, y1 = edges.T
    crosses = (y0 > y) != (y1 > y)
    rise = np.where(crosses, y1 - y0, 1.0)
    return bool(np.count_nonzero(crosses & (x < x0 + (y - y0) * (x1 - x0) / rise)) % 2)


def _to_nearest(edges: Floats, x: float, y: float) -> float:
    """Distance to the nearest edge, m; infinite without edges."""
    if not len(edges):
        return math.inf
    ax, ay = edges[:, 0] - x, edges[:, 1] - y
    bx, by = edges[:, 2] - edges[:, 0], edges[:, 3] - edges[:, 1]
    share = np.clip(-(ax * bx + ay * by) / np.maximum(bx * bx + by * by, 1e-12), 0.0, 1.0)
    return float(np.hypot(ax + share * bx, ay + share * by).min())


def _near(edges: Floats, poses: Floats, radius: float) -> Floats:
    """Edges whose bounding box comes within `radius` of the poses' bounding box."""
    low, high = poses[:, :2].min(axis=0) - radius, poses[:, :2].max(axis=0) + radius
    e_low, e_high = np.minimum(edges[:, :2], edges[:, 2:]), np.maximum(edges[:, :2], edges[:, 2:])
    return np.asarray(edges[((e_low <= high) & (e_high >= low)).all(axis=1)])


def _rectangle_meets(edges: Floats, poses: Floats, half_length: float, half_width: float) -> NDArray[np.bool_]:
    """For each pose (N, 3): does the rectangle around it touch any of the edges (E, 4)? Slab clipping, exact."""
    c, s = np.cos(poses[:, 2])[:, None], np.sin(poses[:, 2])[:, None]
    dx0, dy0 = edges[None, :, 0] - poses[:, 0, None], edges[None, :, 1] - poses[:, 1, None]
    dx1, dy1 = edges[None, :, 2] - poses[:, 0, None], edges[None, :, 3] - poses[:, 1, None]
    ax0, ay0 = c * dx0 + s * dy0, c * dy0 - s * dx0
    ax1, ay1 = c * dx1 + s * dy1, c * dy1 - s * dx1
    enter_x, leave_x = _slab(ax0, ax1 - ax0, half_length)
    enter_y, leave_y = _slab(ay0, ay1 - ay0, half_width)
    meets = np.maximum(np.maximum(enter_x, enter_y), 0.0) <= np.minimum(np.minimum(leave_x, leave_y), 1.0)
    return np.asarray(meets.any(axis=1))


def _slab(start: Floats, way: Floats, half: float) -> tuple[Floats, Floats]:
    """Shares of the way at which it enters and leaves |coordinate| <= half; empty if it never does."""
    moving = np.abs(way) > 1e-12
    safe = np.where(moving, way, 1.0)
    a, b = (-half - start) / safe, (half - start) / safe
    inside = np.abs(start) <= half
    enter = np.where(moving, np.minimum(a, b), np.where(inside, -np.inf, np.inf))
    leave = np.where(moving, np.maximum(a, b), np.where(inside, np.inf, -np.inf))
    return enter, leave
