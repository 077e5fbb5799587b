"""How well a drawn row's place across the robot and its direction are known, and what a look at the row corrects."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class RowFilterParams:
    """Parameters of `RowFilter`. Ours; set on tuning farms.

    Attributes:
        growth_lateral: 1-sigma of the lateral drift of odometry, m per square root of m driven, > 0.
        growth_heading: 1-sigma of the heading drift, rad per square root of m driven, > 0.
        rate_std: 1-sigma of what is left of the gyro's bias, rad/s.
        rate_walk: by so much that changes, rad/s per square root of a second.
        creep_std: 1-sigma of how far the robot creeps downhill per metre driven and unit of slope.
        same_plants: pictures taken within so many metres of a row tell of the same plants, m: together they tell as
            much as one. The last plants of a row tell its direction badly, and it is left by what they told.
        outside_share: from outside what is seen may still change with every metre: a picture never counts for less
            than that share of it.
        end_stds: 1-sigma of where the row lies across the robot, m, and of its direction, rad, by its last plants.
        way_back: all pictures taken back at a row within so many metres count as one, m.
        entrance_share: all that was seen from outside tells no more than a picture with so many times its variance.
    """

    growth_lateral: float = 0.01
    growth_heading: float = 0.001
    rate_std: float = 2e-4
    rate_walk: float = 2e-5
    creep_std: float = 0.3
    same_plants: float = 1.0
    outside_share: float = 0.12
    entrance_share: float = 4.0
    end_stds: tuple[float, float] = (0.03, 0.005)
    way_back: float = 6.0


class RowFilter:
    """Kalman filter of (across, m; direction, rad; turn rate, rad/s; creep): the errors of odometry against the row.

    `covariance` is (4, 4). The errors belong together: a gyro that turns becomes a wrong direction, that and a side
    slope become an error across as the robot drives, and a line laid through plants ahead is off at the robot when it
    is off in its direction. `turn_rate` is what odometry turns too little, learned from the row and kept over the
    headland. `creep` is what it creeps downhill too little.
    """

    def __init__(self, params: RowFilterParams) -> None:
        self._params = params
        self.covariance: Floats = np.diag((0.0, 0.0, 0.0, params.creep_std**2))
        self.creep = 0.0
        self.new_gyro()
        self.unsure(0.0, 0.0)

    def unsure(self, across_std: float, direction_std: float) -> None:
        """Begin with so much doubt of another row, m and rad."""
        rate, creep = self.covariance[2, 2], self.covariance[3, 3]
        self.covariance = np.diag((across_std**2, direction_std**2, rate, creep))
        self._since, self._seen, self._inside = 0.0, False, False

    def new_gyro(self) -> None:
        """The gyro's bias has been measured by other means."""
        self.turn_rate = 0.0
        self.covariance[2, :] = self.covariance[:, 2] = 0.0
        self.covariance[2, 2] = self._params.rate_std**2

    def drive(self, distance: float, dt: float, slope: float = 0.0) -> float:
        """Drive on by odometry for `distance` m, >= 0, in `dt` s; by so much it has turned too little, rad.

        `slope` is the sine of the roll against gravity, positive where the driving frame's left side is up. Until the
        row is seen, the map's word is no worse further on.
        """
        p = self._params
        if self._seen:
            turning = dt if self._inside else 0.0  # from outside, what is seen turns for other reasons
            step = np.eye(4)
            step[0, 1], step[1, 2], step[0, 3] = distance, turning, -slope * distance
            self.covariance = step @ self.covariance @ step.T
        self.covariance += np.diag(
            (p.growth_lateral**2 * distance, p.growth_heading**2 * distance, p.rate_walk**2 * dt, 0.0)
        )
        self._since += distance
        return self.turn_rate * dt

    def take_creep(self) -> float:
        """What odometry should creep more from now on, per metre and unit of slope; asked for once."""
        creep, self.creep = self.creep, 0.0
        return creep

    def look(self, innovation: Floats, noise: Floats, *, inside: bool) -> tuple[float, float]:
        """The correction of across, m, and direction, rad, after a look at the row from inside it or from outside.

        `innovation` (2,) is seen minus expected, m and rad; `noise` (2, 2) its covariance.
        """
        if inside:
            self._enter(noise)
            noise = noise * max(1.0, self._params.same_plants / max(self._since, 1e-6))
        return self._correct(innovation, noise, inside)

    def turn_back(self) -> None:
        """From now on the row is seen from its end: what it is known by are its last plants, not many more."""
        across, direction = self._params.end_stds
        self._at_least(np.diag((across**2, direction**2)))
        self._since = 0.0

    def look_back(self, innovation: Floats, noise: Floats) -> tuple[float, float]:
        """As `look`, back at the row that is left: all pictures show the same plants, and count as one."""
        times = self._params.way_back / max(self._since, 1e-6)
        return self._correct(innovation, noise * max(1.0, times), True)

    def _correct(self, innovation: Floats, noise: Floats, inside: bool) -> tuple[float, float]:
        gain = self.covariance[:, :2] @ np.linalg.inv(self.covariance[:2, :2] + noise)
        self.covariance = self.covariance - gain @ self.covariance[:2, :]
        if not inside:
            self._at_least(self._params.outside_share * noise)
        self._since, self._seen = 0.0, True
        across, direction, rate, creep = (float(a) for a in gain @ innovation)
        self.turn_rate += rate
        self.creep += creep
        return across, direction

    def _enter(self, noise: Floats) -> None:
        """What was seen from outside tells less than one picture from within."""
        if not self._inside:
            self._at_least(self._params.entrance_share * noise)
        self._inside = True

    def _at_least(self, floor: Floats) -> None:
        """Neither across nor direction better known than by `floor` (2, 2)."""
        scale = np.ones(4)
        scale[:2] = np.sqrt(np.maximum(np.diag(floor) / np.diag(self.covariance)[:2], 1.0))
        self.covariance = self.covariance * np.outer(scale, scale)


def look_noise(across_std: float, direction_std: float, correlation: float) -> Floats:
    """Covariance (2, 2) of one look at a row: 1-sigma across it, m, and of its direction, rad."""
    shared = correlation * across_std * direction_std
    return np.array(((across_std**2, shared), (shared, direction_std**2)))
