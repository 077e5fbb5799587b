"""Where along its row the robot is, by the trunks that the plan knows, and which of them comes next."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.row_line import RowLine
from navcore.localization.trunk_match import TrunkMatchParams, match_trunks
from navcore.messages import NextTrunk, PathSegment, PlannedTrunk, RowObservation, ScannedPlant

# A trunk further behind than that has been passed, m.
_PASSED = 0.3


@dataclass(frozen=True, slots=True, kw_only=True)
class AlongTrunksParams:
    """Parameters of `AlongTrunks`.

    Attributes:
        match: of the pattern.
        every: looks are so far apart, m: two from one place have the same errors.
        exact: the place along the row is exact for so many metres after a match.
    """

    match: TrunkMatchParams = field(default_factory=TrunkMatchParams)
    every: float = 0.25
    exact: float = 3.0


class AlongTrunks:
    """Corrects the anchor along the row."""

    def __init__(self, anchor: PathAnchor, params: AlongTrunksParams) -> None:
        self._anchor, self._params = anchor, params
        self.forget()

    def forget(self) -> None:
        """Another row, or the same one the other way."""
        self._looked: float | None = None
        self._matched: float | None = None

    def see(self, seen: RowObservation, segment: PathSegment, T_odom_drive: SE2) -> None:
        """Take an observation of that segment's row; nothing happens without plants or known trunks."""
        row = RowLine.of(segment)
        if row is None or not segment.trunks or not seen.plants:
            return
        at = row.coordinates(self._anchor.T_map_odom @ T_odom_drive)
        if self._looked is not None and abs(at.x - self._looked) < self._params.every:
            return
        self._looked = at.x
        found = match_trunks(
            _placed(seen.plants, at), _known(segment.trunks), self._anchor.along.std, self._params.match
        )
        if isinstance(found, str):
            return
        self._anchor.see_along(row, T_odom_drive, at.x + found.shift, found.std)
        self._looked = self._matched = at.x + found.shift

    def next_trunk(self, segment: PathSegment, pose: SE2) -> NextTrunk | None:
        """The one that the driving frame at `pose` in `map` comes to next."""
        row = RowLine.of(segment)
        if row is None or segment.row_id is None:
            return None
        x = row.coordinates(pose).x
        ahead = next((t for t in segment.trunks if t.along >= x - _PASSED), None)
        if ahead is None:
            return None
        exact = self._matched is not None and abs(x - self._matched) <= self._params.exact
        return NextTrunk(
            row_id=segment.row_id, side=ahead.line, number=ahead.number, of=ahead.of, ahead=ahead.along - x,
            exact=exact,
        )  # fmt: skip


def _placed(plants: tuple[ScannedPlant, ...], at: SE2) -> NDArray[np.float64]:
    """(N, 3) along, lateral and side, in the row's frame."""
    places = [(at @ SE2(plant.x, plant.y, 0.0), plant.side) for plant in plants]
    return np.array([(place.x, place.y, side) for place, side in places], dtype=np.float64)


def _known(trunks: tuple[PlannedTrunk, ...]) -> NDArray[np.float64]:
    """(M, 4) along, lateral, side and 1-sigma."""
    return np.array([(t.along, t.lateral, t.side, t.std) for t in trunks], dtype=np.float64)
