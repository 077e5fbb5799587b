"""What every controller takes and gives."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import Protocol

from navcore.control.target_line import TargetLine
from navcore.errors import NotFiniteError


@dataclass(frozen=True, slots=True, kw_only=True)
class Motion:
    """How the robot moves now, in the driving frame: `v` along x (m/s) and true turn rate `omega` (rad/s).

    `drift` is the direction in which it goes while it points straight ahead, rad: a side slope pulls it down.
    `wheel_omega` is the turn rate that the wheels tell by their nominal track, rad/s, None where they tell nothing.

    Raises NotFiniteError for what is no number.
    """

    v: float
    omega: float
    drift: float = 0.0
    wheel_omega: float | None = None

    def __post_init__(self) -> None:
        if not all(map(isfinite, (self.v, self.omega, self.drift, self.wheel_omega or 0.0))):
            raise NotFiniteError("A robot's motion must be finite numbers.")


@dataclass(frozen=True, slots=True, kw_only=True)
class Steering:
    """Command in the driving frame, and why.

    Attributes:
        v: m/s, as asked.
        omega: rad/s to be commanded, within the limit.
        curvature: of the wanted motion, 1/m, before limits and slip correction.
        turn_gain: share of a commanded turn rate that the ground is believed to give.
        demand: share of the limit on omega that was wanted; above 1 the robot turns less than it should.

    Raises NotFiniteError for a command that is no number.
    """

    v: float
    omega: float
    curvature: float
    turn_gain: float
    demand: float

    @property
    def saturated(self) -> bool:
        """The limit on omega was reached."""
        return self.demand >= 1.0

    def __post_init__(self) -> None:
        if not (isfinite(self.v) and isfinite(self.omega)):
            raise NotFiniteError("A command must be finite numbers: the wanted speed or the look-ahead was none.")


class Controller(Protocol):
    """Follows a target line."""

    @property
    def turn_gain(self) -> float:
        """Share of a commanded turn rate that it believes to reach the ground."""

    @property
    def slip(self) -> float:
        """Curvature that it believes the ground to add to what is steered, 1/m, + left."""

    def steer(self, target: TargetLine, motion: Motion, *, v: float, look_ahead: float, now_ns: int) -> Steering:
        """Command for this tick at the wanted speed `v` >= 0."""

    def reset(self) -> None:
        """Forget what belongs to the last line: called on standstill and on a change of direction."""
