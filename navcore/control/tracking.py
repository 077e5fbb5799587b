"""Who follows the line: the controllers by name, each with the law of its look-ahead."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum

from navcore.control.chord_pursuit import ChordPursuit, ChordPursuitParams
from navcore.control.line_tracker import LineTracker, LineTrackerParams
from navcore.control.look_ahead import (
    AdaptiveLookAheadParams,
    LookAheadParams,
    PublishedLookAheadParams,
    adaptive_look_ahead,
    gnss_look_ahead,
    published_look_ahead,
    row_look_ahead,
)
from navcore.control.lqr_tracker import LqrTracker, LqrTrackerParams
from navcore.control.prediction import ActuatorParams
from navcore.control.steering import Controller
from navcore.control.target_line import AHEAD

# No chassis of ours is faster, m/s.
FASTEST = 2.0


class TrackerName(StrEnum):
    """A controller to choose in the robot's settings.

    PUBLISHED: paper C's pure pursuit. LINE: ours with the look-aheads of paper A. ADAPTIVE: ours, with a look-ahead
    by speed, curvature and room. LQR: a linear quadratic regulator with the slip fed forward.
    """

    PUBLISHED = "published"
    LINE = "line"
    ADAPTIVE = "adaptive"
    LQR = "lqr"


@dataclass(frozen=True, slots=True, kw_only=True)
class Way:
    """What a look-ahead may depend on.

    Attributes:
        v: m/s, wanted. curvature: of the line here, 1/m.
        in_row: the robot drives by what it sees of a row. room: free on either side of its body, m, None in the open.
    """

    v: float
    curvature: float
    in_row: bool
    room: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackingParams:
    """Parameters of the controllers that can be chosen beside today's.

    Attributes:
        name: which of them drives.
    """

    name: TrackerName = TrackerName.LQR
    chord: ChordPursuitParams = field(default_factory=ChordPursuitParams)
    published_look_ahead: PublishedLookAheadParams = field(default_factory=PublishedLookAheadParams)
    adaptive_look_ahead: AdaptiveLookAheadParams = field(default_factory=AdaptiveLookAheadParams)
    lqr: LqrTrackerParams = field(default_factory=LqrTrackerParams)


@dataclass(frozen=True, slots=True)
class Tracking:
    """A controller, and how far ahead it aims, m. `sight`: so much of the line it needs to see ahead, m."""

    controller: Controller
    look_ahead: Callable[[Way], float]
    sight: float


def new_tracking(
    params: TrackingParams, line: LineTrackerParams, look_ahead: LookAheadParams, actuator: ActuatorParams
) -> Tracking:
    """The chosen one. `line` and `look_ahead` are those of today's tracker, which `ADAPTIVE` shares in part."""
    if params.name is TrackerName.PUBLISHED:
        law = params.published_look_ahead
        sight = published_look_ahead(FASTEST, law)
        return Tracking(ChordPursuit(params.chord), lambda way: published_look_ahead(way.v, law), sight)
    if params.name is TrackerName.ADAPTIVE:
        return Tracking(LineTracker(line, actuator), _adaptive(params.adaptive_look_ahead), AHEAD)
    if params.name is TrackerName.LQR:
        return Tracking(LqrTracker(params.lqr, actuator), lambda _: look_ahead.gnss_distance, AHEAD)
    return Tracking(LineTracker(line, actuator), _scheduled(look_ahead), AHEAD)


def _scheduled(params: LookAheadParams) -> Callable[[Way], float]:
    return lambda way: row_look_ahead(way.v, params) if way.in_row else gnss_look_ahead(params)


def _adaptive(params: AdaptiveLookAheadParams) -> Callable[[Way], float]:
    return lambda way: adaptive_look_ahead(way.v, way.curvature, way.room, params)
