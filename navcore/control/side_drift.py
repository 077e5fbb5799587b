"""Where the robot goes while it points along the line, as the line itself shows."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.control.steering import Motion
from navcore.control.target_line import TargetLine


@dataclass(frozen=True, slots=True, kw_only=True)
class SideDriftParams:
    """Attributes:
    distance, scanned_distance: m over which the drift is learnt, > 0; the latter on a line through scanned plants,
        which is known to centimetres.
    most: rad, no more is believed: a side slope of 5 deg pulls by 0.03.
    band: m; further off the line nothing is learnt, for the line itself may be sliding to its place.
    slowest: m/s, slower nothing is learnt.
    """

    distance: float = 2.5
    scanned_distance: float = 1.5
    most: float = 0.06
    band: float = 0.15
    slowest: float = 0.15


class SideDrift:
    """Observer of the lateral error, e' = v (h + angle): what the heading does not explain is drift."""

    def __init__(self, params: SideDriftParams = SideDriftParams()) -> None:
        self._params = params
        self.angle = 0.0
        self._lateral: float | None = None
        self._last_ns = -1

    def standstill(self) -> None:
        """Begin anew: another line, or the same way in the other direction."""
        self.angle, self._lateral, self._last_ns = 0.0, None, -1

    def update(self, now_ns: int, target: TargetLine, motion: Motion) -> None:
        """One tick. Critically damped: both poles at the distance of such a line."""
        p, v = self._params, motion.v
        distance = p.scanned_distance if target.scanned else p.distance
        dt = min((now_ns - self._last_ns) * 1e-9, 0.2) if self._last_ns >= 0 else 0.0
        self._last_ns = now_ns
        if v < p.slowest or abs(target.lateral_error) > p.band or self._lateral is None:
            self._lateral = target.lateral_error
            return
        way, off = v * dt, target.lateral_error - self._lateral
        self._lateral += way * (target.heading_error + motion.drift + self.angle + 2.0 / distance * off)
        self.angle = min(max(self.angle + way * off / distance**2, -p.most), p.most)
