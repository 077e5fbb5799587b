"""Where along its row the robot is: by the row's end, by its having none yet, and by its last plants."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.geometry.se2 import SE2
from navcore.localization.path_anchor import PathAnchor
from navcore.localization.row_line import RowLine
from navcore.messages import RowObservation
from navcore.mission.plant_odometer import PlantOdometer


@dataclass(frozen=True, slots=True, kw_only=True)
class AlongRowParams:
    """Parameters of `AlongRow`.

    Attributes:
        end_std: 1-sigma of the row end's distance as the camera sees it, m.
        blind: a row that ends closer ahead than that has no more plants in the picture, m.
        seen_range: plants further away say nothing sure about where the row ends, m.
        seen_share: share of the distance up to which the row is seen to go on that is believed: a camera that pitches
            by half a degree sees 10 m as 11.
    """

    end_std: float = 0.4
    blind: float = 3.0
    seen_range: float = 7.0
    seen_share: float = 0.9


class AlongRow:
    """Corrects the anchor along the row, by the camera that is driven on."""

    def __init__(self, anchor: PathAnchor, params: AlongRowParams) -> None:
        self._anchor, self._params = anchor, params
        self._odometer = PlantOdometer(anchor)

    def see(self, seen: RowObservation, row: RowLine, T_odom_drive: SE2, length: float, *, at_end: bool) -> None:
        """Take an observation of a row of `length` m. Once its end is near, its last plants tell the way to it.

        Over a whole row the drawn length is better than the plants, which weeds make 2 % too far.
        """
        if at_end or seen.end_distance is not None:
            T_map_drive = self._anchor.T_map_odom @ T_odom_drive
            self._odometer.take(row, T_map_drive, seen.driven, seen.driven_since_ns)
        else:
            self._odometer.begin()
        self._see_end(seen, row, T_odom_drive, length)

    def _see_end(self, seen: RowObservation, row: RowLine, T_odom_drive: SE2, length: float) -> None:
        p = self._params
        if seen.end_distance is not None:
            self._anchor.see_along(row, T_odom_drive, length - seen.end_distance, p.end_std)
        elif seen.seen_to is not None:
            sure = p.seen_share * min(seen.seen_to, p.seen_range)
            self._anchor.see_no_end(row, T_odom_drive, length - sure)

    def past_last_plants(self, seen: RowObservation | None) -> bool:
        """Nothing more of the row will come into the picture."""
        return seen is not None and seen.end_distance is not None and seen.end_distance < self._params.blind
