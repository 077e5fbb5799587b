"""The row's end: where the objects of both sides stop. Ours; paper A leaves its row-end detector undescribed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.perception.row_lines import GroundRow

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class RowEndParams:
    """When a gap ahead is the end. Ours; set on rendered frames.

    Attributes:
        reliable_range: up to there, m ahead, a trunk or post that stands free is seen nearly always.
        gap: so much of both lines must be without objects, m; more than any usual gap between plants.
        uneven: one line may end so much before the other, m.
        agree: two sightings of the end belong together within that distance, m.
        least_gain: weight of a sighting after many: half a degree of pitch moves what stands 5 m ahead by 0.3 m,
            while slipping wheels lose the place only slowly.
        frames: so many sightings in a row, in agreement, make the end known.
        forget_frames: so many pictures in a row with objects beyond it make it unknown again.
    """

    reliable_range: float = 10.0
    gap: float = 4.0
    uneven: float = 1.4
    agree: float = 0.7
    least_gain: float = 0.1
    frames: int = 4
    forget_frames: int = 2


class RowEnd:
    """Remembers the end over pictures and moves it closer as the robot drives."""

    def __init__(self, params: RowEndParams) -> None:
        self._params = params
        self._distance: float | None = None
        self._sightings = 0
        self._contradictions = 0

    def forget(self) -> None:
        """No end is known."""
        self._distance, self._sightings, self._contradictions = None, 0, 0

    def update(self, row: GroundRow | None, driven: float) -> float | None:
        """Distance ahead of the driving frame's origin at which the row ends, m; None if no end is in sight.

        `driven` is the distance driven along the row since the last picture. Once known, the end is carried on when
        the last objects leave the picture.
        """
        if self._distance is not None:
            self._distance -= driven
        if row is not None:
            self._see(row.left_x, row.right_x)
        return self._distance if self._sightings >= self._params.frames else None

    def _see(self, left: Floats, right: Floats) -> None:
        x, last = np.concatenate((left, right)), row_end(left, right, self._params)
        if last is None:
            self._miss(x)
        elif self._distance is not None and abs(last - self._distance) <= self._params.agree:
            self._sightings, self._contradictions = self._sightings + 1, 0
            self._distance += max(1.0 / self._sightings, self._params.least_gain) * (last - self._distance)
        elif self._sightings < self._params.frames:
            self._distance, self._sightings = last, 1
        else:
            self._miss(x)

    def _miss(self, x: Floats) -> None:
        """A picture that does not show the end where it is thought to be; it counts if it shows objects beyond."""
        p = self._params
        if self._distance is None or not np.any(x > self._distance + p.agree):
            return
        self._contradictions += 1
        if self._sightings < p.frames or self._contradictions >= p.forget_frames:
            self.forget()


def row_end(left: Floats, right: Floats, params: RowEndParams) -> float | None:
    """Distance at which the row ends: halfway between the last objects of its two lines; None if no end is in sight.

    Where one line stops much earlier, its last objects were not seen, and the other line tells alone.
    """
    last = last_object(np.concatenate((left, right)), params)
    if last is None:
        return None
    lasts = [float(np.max(x[x <= last])) for x in (left, right) if np.any(x <= last)]
    return float(np.mean(lasts)) if last - min(lasts) <= params.uneven else last


def last_object(x: Floats, params: RowEndParams) -> float | None:
    """Distance of the last object before the gap that ends the row; None if there is none within the reliable range.

    `x` (N,) are the distances of the objects on both lines. One object alone is no row that could end.
    """
    ahead = np.sort(x[np.isfinite(x)])
    if len(ahead) < 2:
        return None
    gaps = np.diff(np.append(ahead, np.inf))
    end = float(ahead[int(np.argmax(gaps > params.gap))])
    return end if end + params.gap <= params.reliable_range else None


def seen_to(x: Floats, params: RowEndParams) -> float | None:
    """Distance up to which the row surely goes on; None if there is too little to say so.

    `x` as in `last_object`. The last but one counts, so that a single false object does not prolong the row.
    """
    ahead = np.sort(x[np.isfinite(x)])
    if len(ahead) < 4:
        return None
    gaps = np.diff(np.append(ahead, np.inf))
    last = int(np.argmax(gaps > params.gap))
    return float(ahead[last - 1]) if last >= 3 else None
