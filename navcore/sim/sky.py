"""Where the satellites stand: three Walker shells of 24, like GPS, Galileo and BeiDou MEO."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_EARTH_RATE = 7.2921159e-5
_EARTH_RADIUS_KM = 6371.0
_INCLINATION = math.radians(55.5)
# Orbit radius (km), period (s), planes of each shell.
_SHELLS = ((26560.0, 43078.0, 6), (29600.0, 50685.0, 3), (27906.0, 46392.0, 3))


def visible_satellites(time_s: float, lat_deg: float, mask_deg: float = 7.0) -> Floats:
    """Unit vectors (N, 3) east, north, up to the satellites above the mask; `time_s` of any epoch."""
    towards = np.concatenate([_towards(time_s, math.radians(lat_deg), shell) for shell in range(3)])
    return np.asarray(towards[towards[:, 2] > math.sin(math.radians(mask_deg))])


def _towards(time_s: float, lat: float, shell: int) -> Floats:
    radius, period, planes = _SHELLS[shell]
    per_plane = 24 // planes
    k = np.arange(24)
    node = (k // per_plane) * (2.0 * math.pi / planes) + shell
    anomaly = (k % per_plane) * (2.0 * math.pi / per_plane) + 0.26 * k + 2.0 * math.pi * time_s / period
    ci, si = math.cos(_INCLINATION), math.sin(_INCLINATION)
    position = radius * np.column_stack(
        (
            np.cos(node) * np.cos(anomaly) - np.sin(node) * np.sin(anomaly) * ci,
            np.sin(node) * np.cos(anomaly) + np.cos(node) * np.sin(anomaly) * ci,
            np.sin(anomaly) * si,
        )
    )
    R_enu_inertial = _enu_axes(lat, _EARTH_RATE * time_s)
    away = position @ R_enu_inertial.T - (0.0, 0.0, _EARTH_RADIUS_KM)
    return np.asarray(away / np.linalg.norm(away, axis=1)[:, None])


def _enu_axes(lat: float, angle: float) -> Floats:
    """Rows: east, north, up at a latitude and an angle of the turned Earth."""
    up = np.array((math.cos(lat) * math.cos(angle), math.cos(lat) * math.sin(angle), math.sin(lat)))
    east = np.array((-math.sin(angle), math.cos(angle), 0.0))
    return np.stack((east, np.cross(up, east), up))
