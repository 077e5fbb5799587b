"""Length and duration of a plan."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

from navcore.messages import MissionPlan, PathSegment

# Standing still at each change of direction: stop, other camera, start, s.
_CHANGE_S = 3.0
_SLOWEST = 0.05


@dataclass(frozen=True, slots=True)
class Preview:
    """Attributes: length in m, duration in s at the planned speeds."""

    length: float
    duration: float


def preview(plan: MissionPlan) -> Preview:
    """What the operator may expect of a plan."""
    changes = sum(a.reverse is not b.reverse for a, b in pairwise(plan.segments))
    length = sum(segment_length(segment) for segment in plan.segments)
    return Preview(length, sum(segment_duration(segment) for segment in plan.segments) + changes * _CHANGE_S)


def segment_length(segment: PathSegment) -> float:
    """m."""
    return sum(math.dist(a, b) for a, b in pairwise(segment.points))


def segment_duration(segment: PathSegment) -> float:
    """s."""
    steps = zip(pairwise(segment.points), pairwise(segment.speeds), strict=True)
    return sum(math.dist(a, b) / max((v + w) / 2, _SLOWEST) for (a, b), (v, w) in steps)
