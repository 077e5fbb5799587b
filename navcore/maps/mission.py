"""A mission as the operator edits it. `planning` turns it into a `MissionPlan`."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


@dataclass(frozen=True, slots=True, kw_only=True)
class Waypoint:
    """A point of the road part, in `map`, with the speed wanted on the way to it, m/s."""

    x: float
    y: float
    speed: float = 0.8


class RowExit(StrEnum):
    """What to do at the far end of a row."""

    NEXT_ROW = "next_row"
    REVERSE = "reverse"
    THROUGH = "through"


@dataclass(frozen=True, slots=True, kw_only=True)
class RowVisit:
    """Drive one row.

    Attributes:
        from_start: entered at the row's `start` (else at its `end`).
        exit: NEXT_ROW changes to the next visit by a headland turn; REVERSE drives back out by the rear camera;
            THROUGH leaves at the far end onto the inbound waypoints.
        speed: m/s in the row.
        stop_at: id of a trunk of the site's trunk map beside which the robot stops and waits for the operator; it
            drives no further into the row, and leaves it in reverse. None: the whole row.
    """

    row_id: str
    from_start: bool = True
    exit: RowExit = RowExit.REVERSE
    speed: float = 0.6
    stop_at: str | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class Mission:
    """Warehouse -> outbound waypoints -> rows -> inbound waypoints -> warehouse."""

    id: str
    name: str
    outbound: tuple[Waypoint, ...]
    visits: tuple[RowVisit, ...]
    inbound: tuple[Waypoint, ...]
