"""Where a person says that the robot stands."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class ToldPlace:
    """A press on the map and the direction of an arrow: right to a metre and a half and 30 degrees.

    Attributes:
        x, y, yaw: `base_link` in `map`, m and rad.
        datum: (lat deg, lon deg, height m) of the farm on whose map it was pressed.
    """

    x: float
    y: float
    yaw: float
    datum: tuple[float, float, float]
