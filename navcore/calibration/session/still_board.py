"""Whether a board is held still, and whether its pose is a new one: then its picture is worth taking."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from navcore.calibration.board import BoardSighting

NS = 1_000_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class StillBoardParams:
    """What counts. Ours; a hand that tries moves a board 0.5 m away by 2 mm.

    Attributes:
        still_share: largest way of a corner within `still_s`, share of the picture's width; > 0.
        still_s: so long; 0.2 to 5 s.
        new_share: a pose is new if some corner is so far from where each earlier picture has it, share of the width.
        longest_gap_s: pictures further apart tell nothing of the time between them.
    """

    still_share: float = 0.006
    still_s: float = 0.7
    new_share: float = 0.03
    longest_gap_s: float = 1.5


class StillBoard:
    """Follows one board through the pictures."""

    def __init__(self, params: StillBoardParams) -> None:
        self._params = params
        self._began: BoardSighting | None = None
        self._began_ns = self._last_ns = 0

    @property
    def since_ns(self) -> int:
        """Capture of the first picture that shows it where it is still."""
        return self._began_ns

    def see(self, sighting: BoardSighting | None, stamp_ns: int) -> float:
        """How much of the time that is asked for it has been still, 0 to 1, with the picture of `stamp_ns`."""
        gap_s = (stamp_ns - self._last_ns) / NS
        self._last_ns = stamp_ns
        fresh = self._began is None or not 0.0 < gap_s <= self._params.longest_gap_s
        if sighting is None or fresh or self._way(sighting) > self._params.still_share:
            self._began, self._began_ns = sighting, stamp_ns
        return min(1.0, (stamp_ns - self._began_ns) / NS / self._params.still_s) if self._began is not None else 0.0

    def is_new(self, sighting: BoardSighting, earlier: Iterable[BoardSighting]) -> bool:
        """Whether it adds something to those."""
        return all(way(sighting, other) >= self._params.new_share for other in earlier)

    def _way(self, sighting: BoardSighting) -> float:
        return way(sighting, self._began) if self._began is not None else np.inf


def way(a: BoardSighting, b: BoardSighting) -> float:
    """How far the corner that moved most did, share of the picture's width; infinite if no corner is in both."""
    common, in_a, in_b = np.intersect1d(a.ids, b.ids, return_indices=True)
    if not len(common) or a.size != b.size:
        return float("inf")
    apart = a.pixels[in_a] - b.pixels[in_b]
    return float(np.hypot(apart[:, 0], apart[:, 1]).max()) / a.width_px
