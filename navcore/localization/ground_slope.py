"""What leans the IMU besides a wheel in a rut: the land's own slope, and how the IMU is mounted.

The land's slope stays where it is when the robot turns, the mount's turns with it: that tells them apart. Two things
speak of their sum: over many metres a robot stands upright on the land, and a camera that sees plants on both sides
come nearer at different rates knows how it leans against the ground they stand on. Of the land alone the heights
speak that GNSS tells on the way: the road along the headland climbs as the rows lean to the side.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

# Before the first height, m: no ground on Earth lies further from the ellipsoid.
UNKNOWN_LEVEL = 10_000.0
# Heights are taken so far apart, m.
HEIGHT_STEP = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundSlopeParams:
    """Parameters of `GroundSlope`; all > 0.

    Attributes:
        land_deg, land_length: 1-sigma of the land's slope, and the way over which it becomes another, m.
        mount_deg: 1-sigma of how the IMU's axes and zeros are off.
        bump_deg, bump_length: 1-sigma of the lean in ruts and bumps, and the way over which it lasts, m.
        gate, height_gate: a reading of the camera, or a height, further off than so many 1-sigma is not believed,
        insist: unless so many in a row say the same: then the mount has moved, or the level is not known any more.
        moved_deg: 1-sigma of how far a mount that has moved is off.
        height_std, height_length: 1-sigma of a height about the land's plane, m, by bumps and by GNSS, and the way
            over which it lasts, m.
        level_drift: so much the plane's level becomes unsure, m per square root of m driven.
    """

    land_deg: float = 1.5
    land_length: float = 300.0
    mount_deg: float = 0.7
    bump_deg: float = 1.2
    bump_length: float = 10.0
    gate: float = 2.5
    height_gate: float = 3.5
    insist: int = 3
    moved_deg: float = 6.0
    height_std: float = 0.08
    height_length: float = 4.0
    level_drift: float = 0.01


class GroundSlope:
    """Kalman filter: slope along x and y of `odom`, mount along x and y of `base_link`, rad; the land's level, m.

    Tilts are (forward, left): tangents of how much the ground, or the IMU, rises ahead and to the left. The level is
    the height of the land's plane where the robot is.
    """

    def __init__(self, params: GroundSlopeParams) -> None:
        self.params = params
        self._land_var, mount_var = math.radians(params.land_deg) ** 2, math.radians(params.mount_deg) ** 2
        self._state: Floats = np.zeros(5)
        self._covariance: Floats = np.diag((self._land_var, self._land_var, mount_var, mount_var, UNKNOWN_LEVEL**2))
        self._refused: list[float] = []
        self._heights_refused, self._since_height = 0, 0.0

    def tilt(self, yaw: float) -> tuple[float, float]:
        """(forward, left) of an upright robot's IMU at a yaw in `odom`."""
        forward, left = _turned_to_body(yaw) @ self._state
        return float(forward), float(left)

    def drive(self, distance: float, yaw: float, tilt: tuple[float, float]) -> None:
        """The IMU was tilted so over some metres: on the whole the robot stands upright on its ground."""
        p = self.params
        fades = math.exp(-distance / p.land_length)
        self._state[:2] *= fades
        self._covariance[:2, :] *= fades
        self._covariance[:, :2] *= fades
        self._covariance[[0, 1], [0, 1]] += (1.0 - fades**2) * self._land_var
        noise = math.radians(p.bump_deg) ** 2 * 2.0 * p.bump_length / distance
        self._update(_turned_to_body(yaw), np.asarray(tilt), np.diag((noise, noise)))

    def move(self, x: float, y: float) -> None:
        """The robot has moved by so much in `odom`, m: the land's plane is higher or lower there."""
        step = np.eye(5)
        step[4, 0], step[4, 1] = x, y
        distance = math.hypot(x, y)
        self._state = step @ self._state
        self._covariance = step @ self._covariance @ step.T
        self._covariance[4, 4] += self.params.level_drift**2 * distance
        self._since_height += distance

    def see_height(self, height: float) -> None:
        """The robot stands at that height, m, by GNSS with a fix. One that is far off is a false fix, unless it
        insists: then the level is not known any more.
        """
        p = self.params
        if self._since_height < HEIGHT_STEP:
            return
        noise = p.height_std**2 * max(1.0, p.height_length / self._since_height)
        off = height - float(self._state[4])
        if abs(off) > p.height_gate * math.sqrt(float(self._covariance[4, 4]) + noise):
            self._heights_refused += 1
            if self._heights_refused >= p.insist:
                self._forget_level()
            return
        self._heights_refused, self._since_height = 0, 0.0
        self._update(np.eye(5)[4:], np.array([height]), np.array([[noise]]))

    def _forget_level(self) -> None:
        self._covariance[4, :] = self._covariance[:, 4] = 0.0
        self._covariance[4, 4] = UNKNOWN_LEVEL**2

    def see_lean(self, yaw: float, more: float, std: float) -> None:
        """The camera leans by `more` to the side (roll, rad) than the IMU and this slope told, 1-sigma `std`."""
        H = _turned_to_body(yaw)[1:]
        if self._believable(more, math.sqrt(float((H @ self._covariance @ H.T)[0, 0]) + std**2)):
            self._update(H, H @ self._state - more, np.array([[std**2]]))

    def _believable(self, more: float, innovation_std: float) -> bool:
        """Not too far off, or insisted on: then nobody knows the mount any more."""
        if abs(more) <= self.params.gate * innovation_std:
            self._refused.clear()
            return True
        same = [reading for reading in self._refused if reading * more > 0.0]
        self._refused = [*same, more]
        if len(self._refused) < self.params.insist:
            return False
        self._covariance[[2, 3], [2, 3]] += math.radians(self.params.moved_deg) ** 2
        self._refused.clear()
        return True

    @property
    def mount_roll(self) -> tuple[float, float]:
        """By how much the camera leans to the right against the IMU, rad, and its 1-sigma."""
        return -float(self._state[3]), math.sqrt(float(self._covariance[3, 3]))

    def _update(self, H: Floats, measured: Floats, noise: Floats) -> None:
        gain = self._covariance @ H.T @ np.linalg.inv(H @ self._covariance @ H.T + noise)
        self._state = self._state + gain @ (measured - H @ self._state)
        self._covariance = (np.eye(5) - gain @ H) @ self._covariance


def _turned_to_body(yaw: float) -> Floats:
    """From the state to (forward, left) in `base_link`, (2, 5)."""
    c, s = math.cos(yaw), math.sin(yaw)
    return np.array(((c, s, 1.0, 0.0, 0.0), (-s, c, 0.0, 1.0, 0.0)))
