"""The three courses of 100 m on which following is measured."""

from __future__ import annotations

import math

import numpy as np

from navcore.geometry.polyline import Polyline


def straight() -> Polyline:
    """100 m north-east."""
    return Polyline(np.outer(np.linspace(0.0, 100.0, 1001), (math.sqrt(0.5), math.sqrt(0.5))))


def curve() -> Polyline:
    """100 m of an S: arcs of 12 m radius, left and right."""
    s = np.arange(0.0, 100.0, 0.1)
    return _integrated(np.where((s // 25.0) % 2 == 0, 1.0, -1.0) / 12.0)


def zigzag(radius: float = 1.5) -> Polyline:
    """A Z: legs of about 33 m, turns of 120 deg, corners rounded to `radius`."""
    turn = math.radians(120.0)
    leg = 33.3 - radius * math.tan(turn / 2)
    parts = [(0.0, leg), (1 / radius, turn * radius), (0.0, leg - radius * math.tan(turn / 2))]
    parts += [(-1 / radius, turn * radius), (0.0, leg)]
    ends = np.cumsum([length for _, length in parts])
    s = np.arange(0.0, ends[-1], 0.1)
    return _integrated(np.array([parts[min(int(np.searchsorted(ends, v)), 4)][0] for v in s]))


def _integrated(curvature: np.ndarray[tuple[int], np.dtype[np.float64]]) -> Polyline:
    heading = np.concatenate(((0.0,), np.cumsum(curvature * 0.1)))
    middle = heading[:-1] + 0.05 * curvature
    steps = 0.1 * np.column_stack((np.cos(middle), np.sin(middle)))
    return Polyline(np.vstack(((0.0, 0.0), np.cumsum(steps, axis=0))))
