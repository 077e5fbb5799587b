"""How well the place along a drawn row is known, and by how much what is seen of its end corrects it."""

from __future__ import annotations

import math

from navcore.localization.path_anchor_params import PathAnchorParams


class AlongFilter:
    """Kalman filter of one number, the place along the row, m: wheels that slip tell too many metres.

    `variance`, m^2, is that of the map where the row is new, and grows with `driven`, the metres since then.
    """

    def __init__(self, params: PathAnchorParams) -> None:
        self._params = params
        self.unsure()

    def unsure(self) -> None:
        """The place is known by the map alone."""
        self.next_row()
        self._contradictions = 0

    def next_row(self) -> None:
        """Another row, whose ends the map tells as badly."""
        self.variance = self._params.map_along**2
        self.driven = self._held_back = 0.0

    @property
    def std(self) -> float:
        """1-sigma of the place, m."""
        return math.sqrt(self.variance)

    def drive(self, distance: float) -> None:
        """Drive on by odometry for so many metres, >= 0."""
        self.driven += distance
        self.variance += self._params.growth_along**2 * distance

    def hold_back(self, metres: float) -> None:
        """So many of the driven metres have been taken for slip."""
        self._held_back += metres

    def see(self, off: float, std: float) -> float | None:
        """Metres ahead by which the place is corrected after it was seen `off` m ahead; None if that is not believed.

        `std` is 1-sigma of `off`, m.
        """
        self._doubt(abs(off), std)
        if self._contradictions:
            return None
        gain = self.variance / (self.variance + std**2)
        self.variance *= 1.0 - gain
        return gain * off

    def _doubt(self, off: float, std: float) -> None:
        """Count the ends in a row that lie too far off; when they insist, be as unsure as before the first."""
        p = self._params
        if off <= p.gate * math.hypot(self.std, std):
            self._contradictions = 0
            return
        self._contradictions += 1
        unsure = p.map_along**2 + p.growth_along**2 * self.driven
        if self._contradictions >= p.insist and off <= p.gate * math.hypot(math.sqrt(unsure), std):
            self.variance, self._contradictions = max(self.variance, unsure), 0

    def see_beyond(self, beyond: float) -> float:
        """Metres by which a place is put back that lies `beyond` m further than a row that goes on allows.

        Wheels that slip tell more metres than were driven: 66 m on bare soil become 70. More than wheels can slip is
        not believed, or something that stands beyond the row could hold the robot for ever.
        """
        back = min(beyond, self._params.slip.most * self.driven - self._held_back)
        if back > 0.0:
            self._held_back += back
            return back
        return 0.0
