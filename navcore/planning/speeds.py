"""Planned speed at each point of a path."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.polyline import Polyline
from navcore.planning.params import PlanningParams
from navcore.vehicle import VehicleParams

Floats = NDArray[np.float64]

# Curvature is taken over this length, m: a single bent step of a drawn line is no curve.
_OVER = 0.5


def planned_speeds(points: Floats, wanted: Floats, vehicle: VehicleParams, params: PlanningParams) -> Floats:
    """Speeds (N,): as wanted (N,), bounded by the curvature there, changing no faster than braking allows."""
    line = Polyline(points)
    curve = _smoothed_curvature(line)
    bounds = params.curve_speeds(curve, vehicle)
    speeds = np.clip(wanted, 0.0, np.minimum(vehicle.max_speed, bounds))
    return np.maximum(_eased(_eased(speeds, line.s, params.braking)[::-1], -line.s[::-1], params.braking)[::-1], 0.05)


def _smoothed_curvature(line: Polyline) -> Floats:
    """Curvature (N,) as the change of direction over a short length around each point."""
    turn = np.concatenate(((0.0,), np.cumsum(line.curvatures[1:-1] * 0.5 * (line.s[2:] - line.s[:-2])), (0.0,)))
    turn[-1] = turn[-2]
    before, after = line.s - _OVER / 2, line.s + _OVER / 2
    return np.asarray((np.interp(after, line.s, turn) - np.interp(before, line.s, turn)) / _OVER)


def _eased(speeds: Floats, s: Floats, acceleration: float) -> Floats:
    """Speeds that rise along s no faster than the acceleration: v^2 <= v0^2 + 2 a ds."""
    squares, gains = (speeds**2).tolist(), (2.0 * acceleration * np.diff(s)).tolist()
    for i, gain in enumerate(gains, start=1):
        squares[i] = min(squares[i], squares[i - 1] + gain)
    return np.sqrt(np.array(squares, dtype=np.float64))
