"""How far the robot really gets along the row, by the plants that stand there: wheels slip, on wet ground by 12 %."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.perception.plants_along import PlantsAlong
from navcore.perception.row_lines import GroundRow

Floats = NDArray[np.float64]
Mask = NDArray[np.bool_]

# Metres between two pictures that tell nothing of slip.
STANDING = 0.005


@dataclass(frozen=True, slots=True, kw_only=True)
class RowOdometryParams:
    """Parameters of `RowOdometry`.

    Attributes:
        furthest: plants further ahead than that do not count, m: a wrong pitch moves them by decimetres.
        behind: nor do those that a scan shows further behind, m: they tell nothing that the near ones do not.
        gate: a foot belongs to a plant not further off along the row, m.
        known: so many sightings make a plant a mark; steady: its place is their mean, and of no more than so many.
        least: so many marks must be in sight.
        gain: share of what the marks say that is taken over per picture; slip_gain: and into the slip that goes on.
        most: slip beyond that is not carried on, a share.
        weeds: so high up they hide the feet, m, which look further away by that share of the camera's height.
    """

    furthest: float = 7.0
    behind: float = 2.0
    gate: float = 0.35
    known: int = 3
    steady: int = 25
    least: int = 1
    gain: float = 0.25
    slip_gain: float = 0.015
    most: float = 0.25
    weeds: float = 0.015


class Driven(NamedTuple):
    """Metres ahead along the row since the picture at `since_ns`, with which this sight of it began."""

    metres: float
    since_ns: int


class RowOdometry:
    """Compares where plants stand from picture to picture with what the wheels tell. Ours.

    `step` are the metres ahead along the row since the last picture; 0 where no row was seen in it.
    """

    def __init__(self, camera_height: float, params: RowOdometryParams) -> None:
        """`camera_height` over the ground, m."""
        self._params = params
        self._nearer = 1.0 - params.weeds / camera_height
        self.forget()

    def forget(self) -> None:
        """Begin anew: another row, or pictures that do not follow each other."""
        self._plants = PlantsAlong()
        self._driven: Driven | None = None
        self._share = self.step = 0.0

    def see(self, row: GroundRow | None, motion: SE2 | None, stamp_ns: int) -> Driven | None:
        """How far the robot got along the row; None without a row. `motion` as in `RowCue`.

        Where too few plants are in sight the wheels slip as they did last.
        """
        if row is None or motion is None:
            self.forget()
        if row is None:
            return None
        driven = self._driven or Driven(0.0, stamp_ns)
        told = row.along(motion) if motion else 0.0
        likely = (1.0 - self._share) * told
        p, (left, ahead) = self._params, self._ahead(row)
        along = driven.metres + likely + ahead
        beyond = self._plants.further(left, along, p.gate, p.known, p.least)
        self._plants.remember(left, along - p.gain * beyond, p.gate, p.steady)
        self._learn(beyond, told)
        self.step = likely - p.gain * beyond
        self._driven = Driven(driven.metres + self.step, driven.since_ns)
        return self._driven

    def _ahead(self, row: GroundRow) -> tuple[Mask, Floats]:
        """Of the feet that are near: which stand on the left line, and distance along the row, m."""
        p, nearer = self._params, 1.0 if row.scanned else self._nearer
        c, s = nearer * math.cos(row.heading), nearer * math.sin(row.heading)
        left, x, y = row.feet()
        near = (x > -p.behind) & (x < p.furthest)
        return left[near], x[near] * c + y[near] * s

    def _learn(self, beyond: float, told: float) -> None:
        """What the wheels tell too much goes on: the ground is wet for metres."""
        if abs(told) > STANDING:
            share = self._share + self._params.slip_gain * beyond / told
            self._share = min(max(share, -self._params.most), self._params.most)
