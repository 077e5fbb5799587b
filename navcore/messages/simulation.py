"""The simulated world's own truth, for the score. Never an input of the navigator."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.messages.mission_plan import Point


@dataclass(frozen=True, slots=True, kw_only=True)
class SimTruth:
    """The simulated world's own truth: pose of `base_link` in `map`. Never an input of the navigator.

    `roll` and `pitch` are against the ground's mean plane, which is what a camera sees; gravity also knows the slope.
    """

    stamp_ns: int
    x: float
    y: float
    yaw: float
    roll: float
    pitch: float
    v: float
    omega: float


@dataclass(frozen=True, slots=True, kw_only=True)
class TrueRow:
    """A row as it truly is in the simulated world: its centre line, midway between its plants, in `map`."""

    id: str
    start: Point
    end: Point
    width: float


@dataclass(frozen=True, slots=True, kw_only=True)
class SimFarm:
    """The rows of the simulated world, for the score. Never an input of the navigator."""

    stamp_ns: int
    rows: tuple[TrueRow, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class SimContact:
    """The first instant at which the robot's body truly touches a thing: post, trunk, building or keep_out zone.

    (x, y) is the thing's place in `map`, m.
    """

    stamp_ns: int
    kind: str
    x: float
    y: float
