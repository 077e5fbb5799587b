"""A mission plan as the navigator drives it: legs between stops, each one way, with its segments by arc length."""

from __future__ import annotations

import math
from bisect import bisect_right
from dataclasses import dataclass
from itertools import accumulate, groupby

import numpy as np

from navcore.errors import MissionError
from navcore.geometry.polyline import Polyline
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, MissionPlan, PathSegment, SegmentKind

HALF_TURN = SE2(0.0, 0.0, math.pi)
ROW_SEGMENTS = frozenset({SegmentKind.ENTRY, SegmentKind.ROW, SegmentKind.EXIT})


@dataclass(frozen=True, slots=True)
class Place:
    """Where on the route the robot is.

    Attributes:
        leg: index of the leg.
        s: arc length on it, m.
    """

    leg: int
    s: float


def row_length(segment: PathSegment) -> float:
    """Of the row that a segment belongs to, as drawn, m."""
    return math.dist(segment.row_start or (0.0, 0.0), segment.row_end or (0.0, 0.0))


class Leg:
    """Consecutive segments driven the same way; the robot stands still at its end.

    Attributes:
        line: the path in `map`.
        first: index of its first segment in the plan.
    """

    def __init__(self, segments: tuple[PathSegment, ...], first: int) -> None:
        self.segments = segments
        self.first = first
        self.reverse = segments[0].reverse
        points = [p for segment in segments for p in segment.points]
        speeds = [v for segment in segments for v in segment.speeds]
        self.line = Polyline(np.array(points, dtype=np.float64))
        self._speeds = np.array(speeds, dtype=np.float64)
        ends = accumulate(len(segment.points) for segment in segments)
        self.segment_ends = [float(self.line.s[end - 1]) for end in ends]

    @property
    def length(self) -> float:
        """Arc length, m."""
        return self.line.length

    @property
    def camera(self) -> CameraName:
        """The one that looks the way the leg is driven."""
        return CameraName.REAR if self.reverse else CameraName.FRONT

    def driving_pose(self, T_x_base: SE2) -> SE2:
        """Pose of the driving frame: turned by pi on a leg that is driven backwards."""
        return T_x_base @ HALF_TURN if self.reverse else T_x_base

    def row_way(self, s: float, look_out: float) -> str | None:
        """Name of the row that matters at arc length `s` and of the direction in which it is driven."""
        segment = self.row_segment(s, look_out)
        return f"{segment.row_id} {'in reverse' if self.reverse else 'ahead'}" if segment is not None else None

    def segment_index(self, s: float) -> int:
        """Index within the leg of the segment at arc length `s`."""
        return min(bisect_right(self.segment_ends, s), len(self.segments) - 1)

    def segment(self, s: float) -> PathSegment:
        """Segment at arc length `s`."""
        return self.segments[self.segment_index(s)]

    def row_segment(self, s: float, look_out: float) -> PathSegment | None:
        """Of the row at `s`, or of the one whose entry begins within `look_out` metres."""
        here = self.segment(s)
        if here.kind in ROW_SEGMENTS and here.row_start is not None:
            return here
        ahead = self.next_of(s, frozenset({SegmentKind.ENTRY}))
        near = ahead is not None and ahead[1] - s <= look_out
        return ahead[0] if ahead is not None and near and ahead[0].row_start is not None else None

    def row_follows(self, s: float) -> bool:
        """Whether nothing but a headland lies between `s`, at a row's end, and the next row."""
        ahead = self.segments[self.segment_index(s) :]
        on_the_way = (SegmentKind.EXIT, SegmentKind.HEADLAND)
        return next((x.kind for x in ahead if x.kind not in on_the_way), None) is SegmentKind.ENTRY

    def turn_follows(self, s: float) -> bool:
        """Whether the way out of a row, at `s`, goes over into a turn on the headland."""
        i = self.segment_index(s)
        kinds = [x.kind for x in self.segments[i : i + 2]]
        return kinds == [SegmentKind.EXIT, SegmentKind.HEADLAND]

    def speed(self, s: float) -> float:
        """Wanted speed at arc length `s`, m/s."""
        return float(np.interp(s, self.line.s, self._speeds))

    def next_of(self, s: float, kinds: frozenset[SegmentKind]) -> tuple[PathSegment, float] | None:
        """The segment of one of `kinds` at or after `s`, with the arc length at which it begins."""
        for i in range(self.segment_index(s), len(self.segments)):
            if self.segments[i].kind in kinds:
                return self.segments[i], self.segment_ends[i - 1] if i else 0.0
        return None


class Route:
    """All legs of a plan, in order. Raises MissionError for a plan that cannot be followed."""

    def __init__(self, plan: MissionPlan) -> None:
        if not plan.segments:
            raise MissionError(["The mission has no path. Plan it again."])
        self.plan = plan
        self.legs = tuple(_legs(plan.segments))
        self._before = [0.0, *accumulate(leg.length for leg in self.legs)]

    @property
    def length(self) -> float:
        """Arc length of all legs, m."""
        return self._before[-1]

    def driven(self, place: Place) -> float:
        """Metres of the route behind a place."""
        return self._before[place.leg] + min(max(place.s, 0.0), self.legs[place.leg].length)

    def segment_number(self, place: Place) -> int:
        """Index in the plan of the segment at a place."""
        leg = self.legs[place.leg]
        return leg.first + leg.segment_index(place.s)

    def at_end(self, place: Place) -> bool:
        """True on the last leg."""
        return place.leg == len(self.legs) - 1


def _legs(segments: tuple[PathSegment, ...]) -> list[Leg]:
    legs: list[Leg] = []
    first = 0
    for _, group in groupby(segments, key=lambda segment: segment.reverse):
        part = tuple(group)
        legs.append(Leg(part, first))
        first += len(part)
    return legs
