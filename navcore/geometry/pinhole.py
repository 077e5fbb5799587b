"""Pinhole camera on a robot, without distortion: pixels to ground and back."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
# Axes, centre and lens of a camera, for compiled arithmetic.
Compiled = tuple[Floats, tuple[float, float, float], tuple[float, float, float, float]]

# Optical axes (u right, v down, depth forward) of a camera that looks along base_link x.
R_BASE_OPTICAL = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


def rotation_from_rpy(roll: float, pitch: float, yaw: float) -> Floats:
    """Rotation Rz(yaw) Ry(pitch) Rx(roll), shape (3, 3); positive pitch looks down (REP 103)."""
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (math.cos, math.sin))
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def rpy_from_rotation(R: Floats) -> tuple[float, float, float]:
    """Roll, pitch and yaw, rad, of a rotation (3, 3): the inverse of `rotation_from_rpy`, pitch in [-pi/2, pi/2]."""
    pitch = math.asin(min(1.0, max(-1.0, -float(R[2, 0]))))
    return math.atan2(R[2, 1], R[2, 2]), pitch, math.atan2(R[1, 0], R[0, 0])


@dataclass(frozen=True, slots=True, kw_only=True)
class PinholeCamera:
    """Intrinsics in pixels and the mount in `base_link` (whose origin lies on the ground under the robot's centre).

    Attributes:
        x, y, z: camera centre, m.
        roll, pitch, yaw: mount, rad; pitch positive looks down, yaw pi looks backwards.
    """

    width_px: int
    height_px: int
    fx: float
    fy: float
    cx: float
    cy: float
    x: float
    y: float
    z: float
    roll: float = 0.0
    pitch: float = 0.0
    yaw: float = 0.0

    def R_base_camera(self) -> Floats:
        """Rotation from optical axes to `base_link`, shape (3, 3), read only."""
        return _R_base_camera(self.roll, self.pitch, self.yaw)

    def compiled(self) -> Compiled:
        """As compiled arithmetic takes it: its axes in `base_link` (3, 3), its centre, m, and fx, fy, cx, cy."""
        return self.R_base_camera(), (self.x, self.y, self.z), (self.fx, self.fy, self.cx, self.cy)

    def pitched(self, more: float) -> PinholeCamera:
        """The same camera, looking further down by that, rad."""
        return _pitched(self, more)

    def project(self, points_base: Floats) -> Floats:
        """Pixels (N, 2) of points (N, 3) in `base_link`; NaN where a point is not in front of the camera."""
        p = (np.asarray(points_base, dtype=np.float64) - (self.x, self.y, self.z)) @ self.R_base_camera()
        depth = np.where(p[:, 2] > 1e-3, p[:, 2], np.nan)
        return np.column_stack((self.cx + self.fx * p[:, 0] / depth, self.cy + self.fy * p[:, 1] / depth))

    def rays(self, pixels: Floats) -> Floats:
        """Directions (N, 3) in `base_link` of pixels (N, 2), each 1 long along the optical axis."""
        uv = np.asarray(pixels, dtype=np.float64).reshape(-1, 2)
        rays = np.column_stack(((uv[:, 0] - self.cx) / self.fx, (uv[:, 1] - self.cy) / self.fy, np.ones(len(uv))))
        return np.asarray(rays @ self.R_base_camera().T)

    def ground(self, pixels: Floats) -> Floats:
        """Points (N, 2) on the ground plane z = 0 of `base_link` under pixels (N, 2); NaN at or above the horizon."""
        d = self.rays(pixels)
        scale = np.where(d[:, 2] < -1e-6, -self.z / np.minimum(d[:, 2], -1e-6), np.nan)
        return np.column_stack((self.x + scale * d[:, 0], self.y + scale * d[:, 1]))


@lru_cache(maxsize=64)  # asked for a dozen times a picture
def _R_base_camera(roll: float, pitch: float, yaw: float) -> Floats:
    R = rotation_from_rpy(roll, pitch, yaw) @ R_BASE_OPTICAL
    R.setflags(write=False)
    return np.asarray(R)


@lru_cache(maxsize=8)  # likewise
def _pitched(camera: PinholeCamera, more: float) -> PinholeCamera:
    return replace(camera, pitch=camera.pitch + more)


def robot_camera(*, rear: bool = False, width_px: int = 640, height_px: int = 360) -> PinholeCamera:
    """Paper A's camera: 0.8 m high at the front or rear edge, 69 deg wide (RealSense D435i), 6 deg down."""
    f = width_px / 2 / math.tan(math.radians(69.0) / 2)
    return PinholeCamera(
        width_px=width_px, height_px=height_px, fx=f, fy=f, cx=width_px / 2, cy=height_px / 2,
        x=-0.50 if rear else 0.50, y=0.0, z=0.80, pitch=math.radians(6.0), yaw=math.pi if rear else 0.0,
    )  # fmt: skip
