"""Plants of a row found again from picture to picture, by how far along it they stand."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.perception.plants_along import PlantsAlong
from navcore.perception.row_lines import GroundRow

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlantSightingsParams:
    """Parameters of `PlantSightings`, m.

    Attributes:
        least_range, most_range: distances ahead of the camera between which plants count.
        every: one picture per so much driven.
        gate, gate_share: a foot belongs to a plant not further off than `gate`, or that share of its distance.
        blend: share by which a plant's place follows its newest sighting.
    """

    least_range: float = 0.8
    most_range: float = 7.0
    every: float = 0.15
    gate: float = 0.25
    gate_share: float = 0.09
    blend: float = 0.3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sightings:
    """N sightings of plants in the pictures of some metres.

    Attributes:
        picture, plant: (N,) numbers from 0.
        x, y: (N,) ahead of the camera and to its left, m, as an upright camera has it.
        along: (N,) place of the plant along the row by this sighting, m, from where the robot began.
        left: (N,) on the left line.
    """

    picture: Ints
    plant: Ints
    x: Floats
    y: Floats
    along: Floats
    left: NDArray[np.bool_]


class PlantSightings:
    """Collects sightings while the robot drives along one row."""

    def __init__(self, camera_x: float, params: PlantSightingsParams) -> None:
        """`camera_x` ahead of the driving frame's origin, m."""
        self._camera_x, self._params = camera_x, params
        self.forget()

    def forget(self) -> None:
        """Begin anew: another row, or pictures that do not follow each other."""
        self.driven, self._pictures = 0.0, 0
        self._next = 0.0
        self._plants = PlantsAlong()
        self._rows: list[tuple[float, ...]] = []

    def add(self, row: GroundRow, motion: SE2, stretch: float) -> None:
        """Take one picture's row.

        `motion` is `T_last_now` of the driving frame; `stretch` (1/m) frees distances of a known lean: a foot `y` to
        the left is taken 1 + y * stretch times as far away.
        """
        self.driven += row.along(motion)
        if self.driven < self._next:
            return
        self._next = self.driven + self._params.every
        for left, x, y in zip(*(numbers.tolist() for numbers in row.feet()), strict=True):
            self._see(row.heading, left, x, y, stretch)
        self._pictures += 1

    def _see(self, heading: float, left: bool, x: float, y: float, stretch: float) -> None:
        p, c, s = self._params, math.cos(heading), math.sin(heading)
        ahead = (x - self._camera_x) * (1.0 + y * stretch)
        if p.least_range < ahead < p.most_range:
            along = self.driven + (ahead + self._camera_x) * c + y * s
            plant = self._plant(left, along, max(p.gate, p.gate_share * ahead))
            self._rows.append((self._pictures, plant, ahead, y, along, left))

    def _plant(self, left: bool, along: float, gate: float) -> int:
        """Number of the plant that stands there, a new one if none does."""
        i = self._plants.nearest(left, along, gate)
        if i is None:
            return self._plants.add(left, along)
        self._plants.blend(i, along, self._params.blend)
        return i

    def all(self) -> Sightings:
        """What has been collected."""
        rows = np.asarray(self._rows, dtype=np.float64).reshape(-1, 6)
        return Sightings(
            picture=rows[:, 0].astype(np.int64), plant=rows[:, 1].astype(np.int64), x=rows[:, 2], y=rows[:, 3],
            along=rows[:, 4], left=rows[:, 5] > 0.5,
        )  # fmt: skip
