"""From a 2D LiDAR's scan to points in the robot's frame, as if all rays had been taken at the scan's stamp."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import ContractError, InputError, NotFiniteError
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2
from navcore.messages import LidarScan

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

# A robot that turns by more during one scan is no robot of ours, rad (90 deg).
_MOST_TURN = math.pi / 2


@dataclass(frozen=True, slots=True, kw_only=True)
class ScanPointsParams:
    """Which rays count.

    Attributes:
        min_range, max_range: m; paper B's LiDAR measures from 0.2 to 12 m.
    """

    min_range: float = 0.2
    max_range: float = 12.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ScanPoints:
    """The rays of one scan in `base_link` at `stamp_ns`, in the order in which they were taken.

    Attributes:
        stamp_ns: when the last ray was taken.
        xy: (N, 2) where they end, m; NaN where nothing came back.
        origins: (N, 2) where the sensor stood when each was taken, m.
        distances: (N,) m, along the ray.
        valid: (N,) False where nothing came back, or from too near or too far.
    """

    stamp_ns: int
    xy: Floats
    origins: Floats
    distances: Floats
    valid: Mask

    @property
    def centre(self) -> tuple[float, float]:
        """Where the sensor stands at the stamp, m; the origin for a scan without rays."""
        return (float(self.origins[-1, 0]), float(self.origins[-1, 1])) if len(self.origins) else (0.0, 0.0)


def scan_points(
    scan: LidarScan, mount: LidarMount, params: ScanPointsParams, T_first_last: SE2 | None = None
) -> ScanPoints:
    """The scan's points; `T_first_last` is the pose of `base_link` at the last ray in that at the first one.

    The motion in between is taken as even. Without it the robot is taken as standing still. Raises InputError for
    a scan that is none, and ContractError for a motion that no robot makes during one scan.
    """
    angles, distances = _rays(scan)
    valid = (distances >= params.min_range) & (distances <= params.max_range)
    ends = mount.ends(angles, np.where(valid, distances, np.nan))[:, :2]
    origins = np.tile((mount.x, mount.y), (len(angles), 1))
    if T_first_last is not None:
        ends, origins = _at_last(T_first_last, ends, origins)
    return ScanPoints(stamp_ns=scan.stamp_ns, xy=ends, origins=origins, distances=distances, valid=valid)


def _rays(scan: LidarScan) -> tuple[Floats, Floats]:
    """Angles and distances (N,), once they are numbers that can be rays."""
    if len(scan.angles) != len(scan.distances):
        raise InputError(
            f"A scan has {len(scan.angles)} angles but {len(scan.distances)} distances: each ray needs both. "
            "Check the LiDAR's driver."
        )
    if scan.began_ns > scan.stamp_ns:
        raise InputError("A scan ends before it began: check the clock that stamps the LiDAR's rays.")
    angles, distances = np.array(scan.angles, dtype=np.float64), np.array(scan.distances, dtype=np.float64)
    if not (np.isfinite(angles).all() and np.isfinite(distances).all()):
        raise NotFiniteError("A ray's angle or distance is not a number: a ray without a return has distance 0.")
    if (distances < 0.0).any():
        raise InputError("A ray's distance is negative: a ray without a return has distance 0.")
    return angles, distances


def _at_last(T_first_last: SE2, ends: Floats, origins: Floats) -> tuple[Floats, Floats]:
    """Ends and origins (N, 2), each in `base_link` when it was taken, in that of the last ray."""
    if not all(math.isfinite(v) for v in (T_first_last.x, T_first_last.y, T_first_last.yaw)):
        raise NotFiniteError("The motion during a scan is not a number: leave it out if it is not known.")
    if abs(math.remainder(T_first_last.yaw, math.tau)) > _MOST_TURN:
        raise ContractError("The robot turned by more than 90 deg during one scan: the motion is not this scan's.")
    shift, c, s = _poses(T_first_last.inverse(), len(ends))
    return _moved(ends, shift, c, s), _moved(origins, shift, c, s)


def _poses(T_last_first: SE2, n: int) -> tuple[Floats, Floats, Floats]:
    """Of `base_link` at each of n rays in that at the last: shift (n, 2), cosine and sine of the yaw (n,).

    Constant twist: with the velocity (vx, vy, w) that makes the whole motion, a share f of it is
    (V(f w) f v, f w), V(a) = [[sin a, cos a - 1], [1 - cos a, sin a]] / a.
    """
    share = np.linspace(1.0, 0.0, n)
    yaw = math.remainder(T_last_first.yaw, math.tau)
    if abs(yaw) < 1e-9:
        return share[:, None] * (T_last_first.x, T_last_first.y), np.ones(n), np.zeros(n)
    V = np.array(((math.sin(yaw), math.cos(yaw) - 1.0), (1.0 - math.cos(yaw), math.sin(yaw))))
    vx, vy = np.linalg.solve(V, (T_last_first.x, T_last_first.y))
    c, s = np.cos(share * yaw), np.sin(share * yaw)
    return np.column_stack((s * vx + (c - 1.0) * vy, (1.0 - c) * vx + s * vy)), c, s


def _moved(points: Floats, shift: Floats, c: Floats, s: Floats) -> Floats:
    x, y = points[:, 0], points[:, 1]
    return np.column_stack((c * x - s * y, s * x + c * y)) + shift
