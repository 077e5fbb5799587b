"""Trunks and posts that stand along the rows, as they were seen from the rows: where, how thick, how often."""

from __future__ import annotations

import math
from dataclasses import dataclass

from navcore.maps.row_frame import row_frame
from navcore.maps.site_map import Row

# A plant is on a row's line if it stands no further than this from where the line is drawn, m.
BESIDE_LINE = 0.6
# Rows are drawn to about this, along, m.
BEYOND_END = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class MappedTrunk:
    """One trunk or post.

    Attributes:
        id: of the trunk, for as long as it stands: missions refer to it.
        x, y: centre in `map`, m; std its 1-sigma, each way, m. diameter: m.
        times_seen: number of runs that saw it. sureness: 0 to 1, that it is a trunk or a post.
    """

    id: str
    x: float
    y: float
    std: float
    diameter: float
    times_seen: int = 1
    sureness: float = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class TrunkMap:
    """All that are known of a farm."""

    trunks: tuple[MappedTrunk, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class RowTrunk:
    """A trunk as one of a row's.

    Attributes:
        side: 1 on the left line, -1 on the right one, for who looks from the row's `start` to its `end`.
        number: 1 at the row's `start`; `of` stand on that line.
        along: from the row's `start`, m. lateral: from its centre line, positive to the left, m.
    """

    trunk: MappedTrunk
    side: int
    number: int
    of: int
    along: float
    lateral: float

    @property
    def name(self) -> str:
        """As people say it: "left trunk 30 of 52"."""
        return f"{'left' if self.side > 0 else 'right'} trunk {self.number} of {self.of}"


def trunks_of_row(trunk_map: TrunkMap, row: Row) -> tuple[RowTrunk, ...]:
    """Those on the row's two lines, the left line's first, each in the order from `start` to `end`.

    A trunk between two rows is one of both.
    """
    T_row_map = row_frame(row)
    placed = [(t, *T_row_map.apply_point(t.x, t.y)) for t in trunk_map.trunks]
    return _line(row, placed, 1) + _line(row, placed, -1)


def _line(row: Row, placed: list[tuple[MappedTrunk, float, float]], side: int) -> tuple[RowTrunk, ...]:
    length = math.dist(row.start, row.end)
    on = [
        (along, lateral, trunk)
        for trunk, along, lateral in placed
        if abs(lateral - side * row.width / 2.0) <= BESIDE_LINE and -BEYOND_END <= along <= length + BEYOND_END
    ]
    on.sort(key=lambda place: place[0])
    return tuple(
        RowTrunk(trunk=trunk, side=side, number=k, of=len(on), along=along, lateral=lateral)
        for k, (along, lateral, trunk) in enumerate(on, start=1)
    )
