"""A path tied to odometry, and a row that it leads through."""

from __future__ import annotations

from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.path_anchor_params import PathAnchorParams
from navcore.localization.row_line import RowLine

ROW = RowLine(10.0, 5.0, 0.3)


def anchored() -> PathAnchor:
    """A tie that no row has corrected yet."""
    return PathAnchor(SE2(2.0, 1.0, 0.1), PathAnchorParams())


def drive(anchor: PathAnchor, distance: float) -> None:
    """So many metres, at 0.6 m/s."""
    anchor.drive(distance, distance / 0.6, SE2())
