"""The plants that the robot has passed: they go on telling where the row runs when the camera sees few or none ahead.

Seen from near, a foot is known to a few centimetres, and odometry carries it on well for some metres. Towards the
end of a row they are most of what tells its direction.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class PassedPlantsParams:
    """Parameters of `PassedPlants`, m.

    Attributes:
        nearest, furthest: distances ahead of the camera between which a foot is remembered.
        behind: so far behind the camera a plant is forgotten.
        gate: a foot belongs to a plant of its side not further off along the row.
        blend: share by which a plant's place follows its newest sighting.
        std: 1-sigma of a plant about its line, with what its sightings add.
        slant: 1-sigma of the direction in which odometry carries them on, rad: the robot creeps on slopes.
        shift: 1-sigma by which all of them may have been carried aside, m: the body leans otherwise than then.
        least: fewer passed plants say nothing: at the entrance they were seen from the side, while the robot turned.
        wrong: a plant so many 1-sigma off the line is none of it.
    """

    nearest: float = 0.8
    furthest: float = 5.0
    behind: float = 10.0
    gate: float = 0.35
    blend: float = 0.3
    std: float = 0.06
    slant: float = 0.006
    shift: float = 0.04
    least: int = 6
    wrong: float = 3.0


class PassedPlants:
    """Remembered in the driving frame of the newest picture."""

    def __init__(self, camera_x: float, params: PassedPlantsParams) -> None:
        """`camera_x` ahead of the driving frame's origin, m."""
        self._camera_x, self._params = camera_x, params
        self.forget()

    def forget(self) -> None:
        """Another row, or pictures that do not follow each other."""
        self._xy: Floats = np.empty((0, 2))
        self._sides: Ints = np.empty(0, dtype=np.int64)

    def move(self, motion: SE2) -> None:
        """`motion` is `T_last_now` of the driving frame."""
        back = motion.inverse()
        c, s = math.cos(back.yaw), math.sin(back.yaw)
        self._xy = self._xy @ np.array(((c, s), (-s, c))) + (back.x, back.y)
        kept = self._xy[:, 0] > self._camera_x - self._params.behind
        self._xy, self._sides = self._xy[kept], self._sides[kept]

    def see(self, xy: Floats, sides: Ints) -> None:
        """Remember feet (N, 2), m, of which `sides` (N,) tells the line: +1 left, -1 right, 0 none."""
        ahead = xy[:, 0] - self._camera_x
        near = (sides != 0) & (ahead > self._params.nearest) & (ahead < self._params.furthest)
        for foot, side in zip(xy[near], sides[near], strict=True):
            self._see(foot, int(side))

    def _see(self, foot: Floats, side: int) -> None:
        off = np.where(self._sides == side, np.abs(self._xy[:, 0] - foot[0]), np.inf)
        i = int(np.argmin(off)) if len(off) else -1
        if i >= 0 and off[i] <= self._params.gate:
            self._xy[i] += self._params.blend * (foot - self._xy[i])
            return
        self._xy = np.vstack((self._xy, foot))
        self._sides = np.append(self._sides, side)

    def information(self, state: Floats) -> tuple[Floats, Floats]:
        """What those out of sight tell of (offset, heading, width, pitch): information (4, 4) and vector (4,).

        `state` (4,) is where the corridor is expected.
        """
        gone = self._xy[:, 0] < self._camera_x + self._params.nearest
        xy, sides = self._xy[gone], self._sides[gone]
        H = np.column_stack((np.ones(len(xy)), xy[:, 0], 0.5 * sides, np.zeros(len(xy))))
        expected = H @ np.array((state[0], math.tan(state[1]), state[2], 0.0))
        passed = np.maximum(self._camera_x - xy[:, 0], 0.0)
        p, off = self._params, xy[:, 1] - expected
        kept = np.abs(off) <= p.wrong * np.hypot(p.std, p.slant * passed)
        if np.count_nonzero(kept) < p.least:
            return np.zeros((4, 4)), np.zeros(4)
        return _whatever_odometry_did(H[kept], xy[kept, 1], passed[kept], p)


def _whatever_odometry_did(H: Floats, y: Floats, passed: Floats, p: PassedPlantsParams) -> tuple[Floats, Floats]:
    """Information (4, 4) and vector (4,) of `y` = `H` z + slant * `passed` + shift, whatever slant and shift are."""
    nuisance = np.column_stack((passed, np.ones(len(passed)))) / p.std
    H, y = H / p.std, y / p.std
    gain = H.T @ nuisance @ np.linalg.inv(nuisance.T @ nuisance + np.diag((p.slant**-2, p.shift**-2)))
    return H.T @ H - gain @ (nuisance.T @ H), H.T @ y - gain @ (nuisance.T @ y)
