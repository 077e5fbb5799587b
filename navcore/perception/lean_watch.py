"""Watches how the camera leans to the side, from metre to metre of a row."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.geometry.pinhole import PinholeCamera
from navcore.geometry.se2 import SE2
from navcore.perception.lean_fit import Lean, LeanFitParams, fit_lean
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


class LeanWatch:
    """One reading every few metres of a row that is seen without a break."""

    def __init__(self, camera: PinholeCamera, params: LeanWatchParams) -> None:
        """`camera` is mounted in the driving frame."""
        self._height, self._focal_px = camera.z, camera.fx * 640 / camera.width_px
        self._params = params
        self._seen = PlantSightings(camera.x, params.sightings)
        self._first = True

    def forget(self) -> None:
        """The next picture does not follow the last one."""
        self._seen.forget()
        self._first = True

    def see(self, row: GroundRow | None, motion: SE2 | None, told_roll: float) -> Lean | None:
        """How much more than `told_roll` the camera leans, rad; None until enough was driven.

        `motion` as in `RowCue`.
        """
        if row is None or motion is None:
            self.forget()
            return None
        self._seen.add(row, motion, told_roll / self._height)
        if self._seen.driven < (self._params.first_span if self._first else self._params.span):
            return None
        self._first = False
        lean = fit_lean(self._seen.all(), self._height, self._focal_px, self._params.fit)
        self._seen.forget()
        return lean
