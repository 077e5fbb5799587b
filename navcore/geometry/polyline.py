"""Paths as polylines: arc length, projection, look-ahead, curvature."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError, NotFiniteError
from navcore.geometry.angles import wrap_all
from navcore.geometry.se2 import SE2

Floats = NDArray[np.float64]

# Half width of the search around a hint when none is given, m.
DEFAULT_WINDOW = 3.0


@dataclass(frozen=True, slots=True)
class Projection:
    """The path's point nearest to a given one.

    Attributes:
        s: arc length, in [0, length].
        lateral: distance of the given point from the path, positive on its left. Beyond an end it is measured from
            the straight prolongation.
        heading: of the path there, rad.
        x, y: the path's point.
        beyond: how far the given point lies past the last point (positive) or before the first (negative), along
            the path's direction there; 0 in between.
    """

    s: float
    lateral: float
    heading: float
    x: float
    y: float
    beyond: float = 0.0


class Polyline:
    """An immutable path through points (N, 2), N >= 2, in m. Coinciding neighbours are allowed.

    Raises NotFiniteError for NaN or infinity and InputError when there are not two different points.
    """

    __slots__ = (
        "_curvature", "_heading", "_lengths", "_s_list", "_start", "_turn_back", "_ux", "_uy", "_x", "_y",
        "points", "s",
    )  # fmt: skip

    def __init__(self, points: Floats) -> None:
        self.points: Floats = _checked(points)
        steps = np.diff(self.points, axis=0)
        self._lengths = np.hypot(steps[:, 0], steps[:, 1])
        self.s: Floats = np.concatenate(((0.0,), np.cumsum(self._lengths)))
        if not self.s[-1] > 0.0:
            raise InputError("A path needs at least two different points.")
        self._heading = _segment_headings(steps, self._lengths)
        self._curvature = _vertex_curvature(self._heading, self._lengths)
        self._prepared()

    def _prepared(self) -> Polyline:
        """Itself, with what queries need."""
        self._ux, self._uy = np.cos(self._heading), np.sin(self._heading)
        self._x, self._y = self.points[:, 0].copy(), self.points[:, 1].copy()
        # Complex numbers turn a point into a segment's own frame in one product: half the time of real arithmetic.
        self._start, self._turn_back = self._x[:-1] + 1j * self._y[:-1], self._ux - 1j * self._uy
        self._s_list: list[float] = self.s.tolist()
        for array in (self.points, self.s):
            array.setflags(write=False)
        return self

    @property
    def length(self) -> float:
        """Arc length, m."""
        return self._s_list[-1]

    def project(self, x: float, y: float, near_s: float | None = None, window: float | None = None) -> Projection:
        """Nearest point of the path; with `near_s` only where the arc length is within `window` of it.

        The hint is what keeps a robot on its own pass of a path that crosses itself; with it the cost does not grow
        with the path. Raises NotFiniteError for a position that is no number.
        """
        if not (math.isfinite(x) and math.isfinite(y)):
            raise NotFiniteError("Only a finite position can be projected on a path.")
        first, last = self._searched(near_s, DEFAULT_WINDOW if window is None else window)
        local = (complex(x, y) - self._start[first:last]) * self._turn_back[first:last]
        along, across = local.real, local.imag
        clipped = np.minimum(np.maximum(along, 0.0), self._lengths[first:last])
        past = along - clipped
        nearest = int((past * past + across * across).argmin())
        return self._projection(first + nearest, float(clipped[nearest]), x, y)

    def _searched(self, near_s: float | None, window: float) -> tuple[int, int]:
        """Range of segments to search, at least one."""
        count = len(self._s_list) - 1
        if near_s is None:
            return 0, count
        first = min(max(bisect_right(self._s_list, near_s - window) - 1, 0), count - 1)
        return first, max(min(bisect_left(self._s_list, near_s + window), count), first + 1)

    def _projection(self, index: int, along: float, x: float, y: float) -> Projection:
        ux, uy = self._ux.item(index), self._uy.item(index)
        px, py = self._x.item(index) + along * ux, self._y.item(index) + along * uy
        dx, dy = x - px, y - py
        cross, past = ux * dy - uy * dx, ux * dx + uy * dy
        s = self._s_list[index] + along
        at_end = (s >= self._s_list[-1] and past > 0.0) or (s <= 0.0 and past < 0.0)
        lateral = cross if at_end else math.copysign(math.hypot(dx, dy), cross)
        return Projection(s, lateral, self._heading.item(index), px, py, past if at_end else 0.0)

    def _segment(self, s: float) -> int:
        return min(max(bisect_right(self._s_list, s) - 1, 0), len(self._s_list) - 2)

    def _segments(self, s: Floats) -> NDArray[np.intp]:
        """The same for arc lengths (N,)."""
        return np.asarray(np.clip(np.searchsorted(self.s, s, side="right") - 1, 0, len(self._lengths) - 1))

    def vertex_before(self, s: float) -> float:
        """Arc length of the last vertex at or before `s` that begins a segment."""
        return self._s_list[self._segment(s)]

    def at(self, s: float) -> tuple[float, float]:
        """Point at arc length `s`; outside [0, length] on the straight prolongation of the first or last segment."""
        i = self._segment(s)
        along = s - self._s_list[i]
        return float(self._x[i] + along * self._ux[i]), float(self._y[i] + along * self._uy[i])

    def at_all(self, s: Floats) -> Floats:
        """Points (N, 2) at arc lengths (N,), prolonged straight at both ends."""
        s = np.asarray(s, dtype=np.float64)
        i = self._segments(s)
        along = s - self.s[i]
        return np.column_stack((self._x[i] + along * self._ux[i], self._y[i] + along * self._uy[i]))

    def heading_at(self, s: float) -> float:
        """Direction of the segment at arc length `s`, rad."""
        return float(self._heading[self._segment(s)])

    def heading_at_all(self, s: Floats) -> Floats:
        """Directions (N,) of the segments at arc lengths (N,), rad."""
        return np.asarray(self._heading[self._segments(s)])

    def curvature_at(self, s: float) -> float:
        """Curvature, 1/m, positive to the left: turn at the vertices per length, linear in between, 0 outside."""
        if not 0.0 <= s <= self.length:
            return 0.0
        i = self._segment(s)
        step = self._lengths.item(i)
        share = (s - self._s_list[i]) / step if step > 0.0 else 0.0
        return float((1.0 - share) * self._curvature.item(i) + share * self._curvature.item(i + 1))

    @property
    def curvatures(self) -> Floats:
        """Curvature at each point, (N,), 1/m."""
        return self._curvature.copy()

    @property
    def headings(self) -> Floats:
        """Direction of each segment, (N - 1,), rad."""
        return self._heading.copy()

    def slice(self, s0: float, s1: float) -> Polyline:
        """The part between two arc lengths, s0 < s1, cut to [0, length]. Raises InputError if nothing is left."""
        s0, s1 = max(s0, 0.0), min(s1, self.length)
        if not s1 > s0:
            raise InputError("A slice of a path needs a start before its end, both on the path.")
        inner = self.points[(self.s > s0 + 1e-9) & (self.s < s1 - 1e-9)]
        return Polyline(np.vstack((self.at(s0), inner, self.at(s1))))

    def seen_from(self, T_path_viewer: SE2, s0: float, s1: float) -> Polyline:
        """The vertices from the last one before `s0` to the first one after `s1`, in the viewer's frame.

        As quick as it can be, for a robot asks in every tick: lengths and curvatures are those of the path.
        """
        first = self._segment(s0)
        last = max(min(bisect_left(self._s_list, s1), len(self._s_list) - 1), first + 1)
        seen = Polyline.__new__(Polyline)
        seen.points = T_path_viewer.inverse().apply(self.points[first : last + 1])
        seen.s = self.s[first : last + 1] - self.s[first]
        seen._lengths = self._lengths[first:last]
        seen._heading = wrap_all(self._heading[first:last] - T_path_viewer.yaw)
        seen._curvature = self._curvature[first : last + 1]
        return seen._prepared()

    def resampled(self, step: float) -> Polyline:
        """The same course with points evenly spaced by at most `step` m; corners between them are cut."""
        count = max(math.ceil(self.length / step - 1e-9), 1)
        return Polyline(self.at_all(np.linspace(0.0, self.length, count + 1)))

    def reversed(self) -> Polyline:
        """The same points, driven the other way."""
        return Polyline(self.points[::-1])


def _checked(points: Floats) -> Floats:
    p = np.array(points, dtype=np.float64)
    if p.ndim != 2 or p.shape[1] != 2 or len(p) < 2:
        raise InputError(f"A path needs at least two (x, y) points; got an array of shape {p.shape}.")
    if not np.isfinite(p).all():
        raise NotFiniteError("A path must not contain NaN or infinite coordinates.")
    return p


def _segment_headings(steps: Floats, lengths: Floats) -> Floats:
    """Direction of each segment; one without length inherits its predecessor's (the first: its successor's)."""
    heading = np.arctan2(steps[:, 1], steps[:, 0])
    index = np.where(lengths > 0.0, np.arange(len(lengths)), -1)
    index = np.maximum.accumulate(index)
    return np.asarray(heading[np.where(index < 0, int(np.argmax(lengths > 0.0)), index)])


def _vertex_curvature(heading: Floats, lengths: Floats) -> Floats:
    """Turn at each vertex over the mean length of its two segments; the ends repeat their neighbours.

    Segments without length do not count: their two points have one curvature.
    """
    real = lengths > 0.0
    turns = wrap_all(np.diff(heading[real]))
    spans = 0.5 * (lengths[real][1:] + lengths[real][:-1])
    inner = turns / np.maximum(spans, 1e-6) if len(turns) else np.zeros(1)
    vertices = np.concatenate((inner[:1], inner, inner[-1:]))
    return np.asarray(vertices[np.concatenate(((0,), np.cumsum(real)))])
