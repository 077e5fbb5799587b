"""How many of the metres that the wheels tell were not driven, learned from rows.

Skid-steered wheels slip by some per cent on grass and by more on wet soil, always to the same side: they tell too
much. A row is as long as it is drawn but for half a metre, so where its end comes in sight it says how much too much.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class WheelSlipParams:
    """Parameters of `WheelSlip`.

    Attributes:
        std: 1-sigma of the slip of ground that nobody has driven on, a share.
        most: no more is believed.
        length_std: 1-sigma of how long a drawn row truly is, with where the robot was at its beginning, m.
        change_std: by so much the ground differs from row to row, a share.
    """

    std: float = 0.04
    most: float = 0.12
    length_std: float = 0.6
    change_std: float = 0.015


class WheelSlip:
    """`share` of the told metres that were not driven, 0 until a row has told."""

    def __init__(self, params: WheelSlipParams) -> None:
        self.params = params
        self.share = self._before = 0.0
        self._var = self._var_before = params.std**2
        self._told = self._lost = 0.0

    def begin(self) -> None:
        """Another row, or the road."""
        self._before, self._var_before = self.share, self._var + self.params.change_std**2
        self._told = self._lost = 0.0

    def drive(self, told: float, lost: float) -> None:
        """The wheels tell so many metres along the row, of which so many are taken for lost."""
        self._told += told
        self._lost += lost

    def lose(self, metres: float) -> None:
        """So many more of them were not driven; negative: fewer."""
        self._lost += metres

    def see_end(self) -> None:
        """The row's end is in sight: what was lost until here is the wheels' doing."""
        if self._told <= 0.0:
            return
        var = (self.params.length_std / self._told) ** 2
        gain = self._var_before / (self._var_before + var)
        share = self._before + gain * (self._lost / self._told - self._before)
        self._var = (1.0 - gain) * self._var_before
        self.share = min(max(share, 0.0), self.params.most) if math.isfinite(share) else self.share
