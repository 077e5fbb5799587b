"""What a surveyor would know of a pear block: fixed points along its rows and distances between its posts."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Row
from navcore.sim.trellis.posts import Posts

Floats = NDArray[np.float64]

FIXED_POINTS = 14
# Posts are surveyed at this height above their feet, m: they lean.
SURVEY_HEIGHT_M = 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class SurveyedDistance:
    """A level distance between the axes of two posts, indices into `Posts`, m.

    Attributes:
        along: both posts stand in one line; else in neighbouring lines, opposite each other.
    """

    first: int
    second: int
    along: bool
    distance: float


def fixed_points(rows: tuple[Row, ...], count: int = FIXED_POINTS) -> tuple[SE2, ...]:
    """Paper C's fixed points: evenly along the rows' centre lines as a serpentine drive passes them, `map`.

    Every other row is driven from its end to its start. Raises InputError for no row or fewer points than rows.
    """
    if not 1 <= len(rows) <= count:
        raise InputError(f"{count} fixed points need between 1 and {count} rows, but there are {len(rows)}.")
    points: list[SE2] = []
    for i, share in enumerate(np.array_split(np.arange(count), len(rows))):
        begin, end = driven(rows[i], i)
        yaw = math.atan2(end[1] - begin[1], end[0] - begin[0])
        at = (np.arange(len(share)) + 0.5) / len(share)
        points += [
            SE2(begin[0] + a * (end[0] - begin[0]), begin[1] + a * (end[1] - begin[1]), yaw) for a in at.tolist()
        ]
    return tuple(points)


def driven(row: Row, number: int) -> tuple[tuple[float, float], tuple[float, float]]:
    """First and last point of a row's centre line in a serpentine drive of which it is the `number`th, from 0."""
    return (row.start, row.end) if number % 2 == 0 else (row.end, row.start)


def surveyed_distances(posts: Posts, reach: float = 30.0) -> tuple[SurveyedDistance, ...]:
    """True distances at `SURVEY_HEIGHT_M` between standing posts: along lines up to `reach` m, and across rows.

    Posts are opposite each other where each is the other line's nearest.
    """
    spots = posts.axis_at(SURVEY_HEIGHT_M)[:, :2]
    lines = [np.flatnonzero((posts.lines == i) & posts.standing) for i in range(int(posts.lines.max(initial=-1)) + 1)]
    pairs = [(int(a), int(b), True) for line in lines for n, a in enumerate(line) for b in line[n + 1 :]]
    pairs += [pair for one, other in pairwise(lines) for pair in _opposite(spots, one, other)]
    measured = (SurveyedDistance(first=a, second=b, along=along, distance=math.dist(spots[a], spots[b]))
                for a, b, along in pairs)  # fmt: skip
    return tuple(d for d in measured if not d.along or d.distance <= reach)


def _opposite(spots: Floats, one: NDArray[np.intp], other: NDArray[np.intp]) -> list[tuple[int, int, bool]]:
    if not len(one) or not len(other):
        return []
    away = np.linalg.norm(spots[one][:, None] - spots[other][None], axis=2)
    there, back = away.argmin(axis=1), away.argmin(axis=0)
    return [(int(one[i]), int(other[j]), False) for i, j in enumerate(there) if back[j] == i]
