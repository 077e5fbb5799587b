"""Watches how the camera leans to the side, and how it is mounted, from metre to metre of a row."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from navcore.geometry.pinhole import PinholeCamera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraMount
from navcore.perception.lean_fit import Lean, LeanFitParams, fit_lean
from navcore.perception.mount_fit import MountFitParams, fit_mount
from navcore.perception.neighbour_lines import NeighbourLean, NeighbourLinesParams
from navcore.perception.plant_sightings import PlantSightings, PlantSightingsParams
from navcore.perception.row_lines import GroundRow


@dataclass(frozen=True, slots=True, kw_only=True)
class LeanWatchParams:
    """Parameters of `LeanWatch`.

    Attributes:
        span: a reading is made of the pictures of so many metres; first_span: the first one, before the entrance.
    """

    span: float = 4.0
    first_span: float = 2.5
    sightings: PlantSightingsParams = PlantSightingsParams()
    fit: LeanFitParams = LeanFitParams()
    mount: MountFitParams = MountFitParams()
    neighbours: NeighbourLinesParams = NeighbourLinesParams()


@dataclass(frozen=True, slots=True)
class Reading:
    """Of some metres; None where too few plants were passed, or no line beside the row was in sight."""

    lean: Lean | None
    mount: CameraMount | None


class LeanWatch:
    """Readings every few metres of a row that is seen without a break, by its plants and by its neighbours."""

    def __init__(self, camera: PinholeCamera, params: LeanWatchParams) -> None:
        """`camera` is mounted in the driving frame."""
        self._height, self._focal_px = camera.z, camera.fx * 640 / camera.width_px
        self._params = params
        self._seen = PlantSightings(camera.x, params.sightings)
        self._beside = NeighbourLean(camera.z, params.neighbours)
        self._pitched, self._pictures = 0.0, 0
        self.forget()

    def forget(self) -> None:
        """The next picture does not follow the last one."""
        self._begin()
        self._beside.forget()
        self._first = True

    def see(
        self, row: GroundRow | None, motion: SE2 | None, *, told_roll: float, told_pitch: float
    ) -> Reading | None:
        """How much more than told the camera leans, and how it is mounted; None until enough was driven.

        `motion` as in `RowCue`; what is told is the IMU's, rad.
        """
        if row is None or motion is None:
            self.forget()
            return None
        beside = self._beside.see(row, math.hypot(motion.x, motion.y), told_roll)
        self._seen.add(row, motion, told_roll / self._height)
        self._pitched, self._pictures = self._pitched + row.pitch - told_pitch, self._pictures + 1
        if self._seen.driven < (self._params.first_span if self._first else self._params.span):
            return Reading(beside, None) if beside else None
        reading = self._reading()
        self._first = False
        self._begin()
        return replace(reading, lean=together(reading.lean, beside))

    def _begin(self) -> None:
        self._seen.forget()
        self._pitched, self._pictures = 0.0, 0

    def _reading(self) -> Reading:
        seen, p = self._seen.all(), self._params
        mount = fit_mount(seen, self._height, self._focal_px, p.fit, p.mount)
        if mount is not None:
            mount = replace(mount, pitch=mount.pitch + self._pitched / self._pictures)
        return Reading(fit_lean(seen, self._height, self._focal_px, p.fit), mount)


def together(one: Lean | None, other: Lean | None) -> Lean | None:
    """Both readings in one, each for what it is worth."""
    if one is None or other is None:
        return one or other
    a, b = one.std**-2, other.std**-2
    return Lean((a * one.roll + b * other.roll) / (a + b), (a + b) ** -0.5)
