"""A match on the 3D map corrects the belief: position and yaw at once."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from navcore.geometry.angles import wrap
from navcore.localization.belief import STATES, YAW, Belief, Floats, X, Y
from navcore.localization.correction import Innovation
from navcore.localization.verdict import Evidence, Verdict
from navcore.messages import MapMatch


@dataclass(frozen=True, slots=True, kw_only=True)
class MapCorrectionParams:
    """Parameters of `MapCorrection`.

    Attributes:
        gate: squared Mahalanobis distance with 3 degrees of freedom; 21.1 passes 99.99 %.
        position_std: 1-sigma of what the map itself is wrong by, m: it is the same in many matches in a row.
        yaw_std: the same of its direction, rad.
        lasts: so many matches count as one, >= 1: errors of the map last for metres.
    """

    gate: float = 21.1
    position_std: float = 0.015
    yaw_std: float = 0.003
    lasts: float = 4.0


class MapCorrection:
    """Applies matches to a belief that stands at their time of capture."""

    def __init__(self, params: MapCorrectionParams) -> None:
        self._p = params

    def apply(self, b: Belief, match: MapMatch) -> Verdict:
        """Position and yaw; one that lies too far off is refused."""
        residual = np.array((match.x - b.mean[X], match.y - b.mean[Y], wrap(match.yaw - float(b.mean[YAW]))))
        H = np.zeros((3, STATES))
        H[0, X] = H[1, Y] = H[2, YAW] = 1.0
        R = self.noise(match)
        if Innovation(b, H, residual, R).distance() > self._p.gate:
            off = math.hypot(residual[0], residual[1])
            return Verdict(Evidence.MAP, False, f"the 3D map puts the robot {off:.2f} m from where it should be")
        Innovation(b, H, residual, R * self._p.lasts).apply()
        b.match_ns, b.distance = match.stamp_ns, 0.0
        return Verdict(Evidence.MAP, True)

    def noise(self, match: MapMatch) -> Floats:
        """Covariance (3, 3) of one match: its own and the map's."""
        p = self._p
        own = np.array(match.covariance).reshape(3, 3)
        return np.asarray(own + np.diag((p.position_std**2, p.position_std**2, p.yaw_std**2)))
