"""A body that leans sideways sees the row shifted: what it would have seen upright."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from navcore.messages import USUAL_WIDTH, RowObservation
from navcore.perception.plants.scanned_plants import ScannedPlants


def upright_offset(offset: float, width: float, height: float, roll: float) -> float:
    """Offset of the centre line (m, left positive) that a camera `height` above the ground, leaning by `roll`, saw.

    A ground line at lateral X stands at the angle atan(X / h) from the vertical; leaning turns all angles by the
    roll, and carries the camera h sin(roll) to the right. `roll` is positive with the left side up (REP 103), rad.
    """
    left, right = (_turned(offset + side * width / 2, height, roll) for side in (1.0, -1.0))
    return (left + right) / 2 - height * math.sin(roll)


def leaning_offset(offset: float, width: float, height: float, roll: float) -> float:
    """Inverse of `upright_offset` for the same width: what a leaning camera sees of a line at a true offset."""
    beside = offset + height * math.sin(roll)
    left, right = (_turned(beside + side * width / 2, height, -roll) for side in (1.0, -1.0))
    return (left + right) / 2


def leaning_exactly(offset: float, width: float, height: float, roll: float) -> float:
    """The offset that `upright_offset` makes `offset` of, to a millimetre."""
    leaning = leaning_offset(offset, width, height, roll)
    for _ in range(2):  # each step leaves a tenth of the error
        leaning += offset - upright_offset(leaning, width, height, roll)
    return leaning


def leaning_plants(plants: ScannedPlants, camera_height: float, roll: float, land_roll: float = 0.0) -> ScannedPlants:
    """Plants as scanned from the leaning body, where a camera on it sees their feet (m, rad).

    On land that slopes to the side by `land_roll` they grow upright: the scan meets them uphill of their feet.
    """
    uphill = plants.height * math.tan(land_roll)
    beside = plants.xy[:, 1] - uphill + (camera_height - plants.height) * math.sin(roll)
    limit = math.radians(85.0)
    angle = np.clip(np.arctan2(beside, camera_height) - roll, -limit, limit)
    return replace(plants, xy=np.column_stack((plants.xy[:, 0], camera_height * np.tan(angle))))


def level_plants(plants: ScannedPlants, roll: float, land_roll: float = 0.0) -> ScannedPlants:
    """The feet of plants that were scanned from a body leaning by `roll`, on level ground below it (m, rad).

    `land_roll` as in `leaning_plants`.
    """
    aside = plants.height * (math.tan(land_roll) + math.sin(roll))
    return replace(plants, xy=plants.xy - (0.0, aside))


def levelled(row: RowObservation, height: float, roll: float) -> RowObservation:
    """The observation as an upright camera would have made it; `roll` of the driving frame."""
    if not row.valid or row.offset is None:
        return row
    return replace(row, offset=upright_offset(row.offset, row.width or USUAL_WIDTH, height, roll))


def _turned(lateral: float, height: float, angle: float) -> float:
    limit = math.radians(85.0)
    return height * math.tan(min(max(math.atan2(lateral, height) + angle, -limit), limit))
