"""A row seen by the camera corrects cross-track and heading inside it.

The site map may have the row shifted, so the lateral error of the mapped line is a state of its own: what the row
tells is how the robot moves across it, not where on Earth the row is.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2
from navcore.localization.belief import ROW_SHIFT, STATES, YAW, Belief, X, Y
from navcore.localization.correction import Innovation
from navcore.localization.verdict import Evidence, Verdict
from navcore.messages import CameraName, RowObservation


@dataclass(frozen=True, slots=True, kw_only=True)
class RowCorrectionParams:
    """Parameters of `RowCorrection`.

    Attributes:
        shift_std: m, lateral error of a row in the site map, 1-sigma.
        std_factor: observations of neighbouring frames err alike; their 1-sigma is taken wider by this; 1 to 5.
        offset_floor: m, heading_floor: rad; no observation is better than this. The map's row may be turned by
            half a degree.
        gate: squared Mahalanobis distance, 2 degrees of freedom.
    """

    shift_std: float = 0.5
    std_factor: float = 2.0
    offset_floor: float = 0.05
    heading_floor: float = math.radians(3.0)
    gate: float = 18.4


class RowCorrection:
    """Applies row observations to a belief that stands at their time of capture."""

    def __init__(self, params: RowCorrectionParams) -> None:
        self._p = params

    def apply(self, b: Belief, seen: RowObservation, line: SE2) -> Verdict:
        """`line` is a point of the row's centre line in `map` and its direction, either way round."""
        if not seen.valid or seen.offset is None or seen.heading is None:
            return Verdict(Evidence.ROW, False, seen.reason or "no row seen")
        self._take_row(b, line)
        driving_yaw = float(b.mean[YAW]) + (math.pi if seen.camera is CameraName.REAR else 0.0)
        flip = abs(wrap(line.yaw - driving_yaw)) > math.pi / 2
        direction = wrap(line.yaw + (math.pi if flip else 0.0))
        nx, ny = -math.sin(direction), math.cos(direction)
        side = -1.0 if flip else 1.0
        offset = nx * (line.x - b.mean[X]) + ny * (line.y - b.mean[Y]) + side * b.mean[ROW_SHIFT]
        H = np.zeros((2, STATES))
        H[0, X], H[0, Y], H[0, ROW_SHIFT], H[1, YAW] = -nx, -ny, side, -1.0
        residual = np.array((seen.offset - offset, wrap(seen.heading - wrap(direction - driving_yaw))))
        R = np.diag((self._variance(seen.offset_std, self._p.offset_floor),
                     self._variance(seen.heading_std, self._p.heading_floor)))  # fmt: skip
        innovation = Innovation(b, H, residual, R)
        if innovation.distance() > self._p.gate:
            return Verdict(Evidence.ROW, False, f"row is seen {residual[0]:+.2f} m from where it should be")
        innovation.apply()
        return Verdict(Evidence.ROW, True)

    def _take_row(self, b: Belief, line: SE2) -> None:
        key = (line.x, line.y, line.yaw)
        if b.row != key:
            b.forget([ROW_SHIFT], [self._p.shift_std])
            b.row = key

    def _variance(self, std: float | None, floor: float) -> float:
        return max((std or 0.0) * self._p.std_factor, floor) ** 2
