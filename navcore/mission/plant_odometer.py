"""How far the robot really gets along a row, by the plants there: what the wheels tell too much is taken back."""

from __future__ import annotations

from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.row_line import RowLine


class PlantOdometer:
    """Moves the anchor back along the row by the metres that were told and not driven."""

    def __init__(self, anchor: PathAnchor) -> None:
        self._anchor = anchor
        self._since_ns: int | None = None
        self._began = 0.0

    def begin(self) -> None:
        """The next sight of plants is the first: nothing is known of the way to there."""
        self._since_ns = None

    def take(self, row: RowLine, T_map_drive: SE2, driven: float | None, since_ns: int | None) -> None:
        """`driven` m ahead along the row since the picture at `since_ns`, as the plants tell; nothing where None.

        Only the way between two pictures of one sight counts: ends that were seen meanwhile have moved the robot
        along the row, and that stays.
        """
        if driven is None or since_ns is None:
            return
        # Where this sight began, as far as the wheels tell.
        began = row.coordinates(T_map_drive).x + self._anchor.put_back - driven
        if since_ns != self._since_ns:
            self._since_ns, self._began = since_ns, began
        self._anchor.lose(row.heading, began - self._began)
