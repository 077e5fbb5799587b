"""How the path that is followed moves from one tie to another without making the robot jump."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2


@dataclass(frozen=True, slots=True, kw_only=True)
class PathSlideParams:
    """Parameters of `PathSlide`.

    Attributes:
        across, along: how fast the path may move sideways and along the driving direction, m/s, > 0.
        turn: how fast it may turn, rad/s, > 0.
        across_share, along_share, turn_share: the same per metre driven, m, m and rad: a robot that creeps round a
            bend must not chase a path that runs off to the side.
        gentle: share of the first two on the road, where GNSS may move the path by more than a metre in a bend.
        patience: no further away from the robot than this does the path move sideways, m: it waits until the robot
            follows. patience_along: nor along: in a bend that becomes an error to the side.
    """

    across: float = 0.15
    along: float = 0.3
    turn: float = 0.10
    across_share: float = 0.3
    along_share: float = 0.5
    turn_share: float = 0.25
    gentle: float = 0.67
    patience: float = 0.35
    patience_along: float = 0.25


class Reach(NamedTuple):
    """How far the path may move at most, m, m and rad."""

    across: float
    along: float
    turn: float


class PathSlide:
    """Moves a pose towards another one."""

    def __init__(self, params: PathSlideParams) -> None:
        self.params = params

    def reach(self, dt: float, driven: float, *, gentle: bool = False) -> Reach:
        """In `dt` s and over `driven` m, >= 0."""
        p, share = self.params, self.params.gentle if gentle else 1.0
        return Reach(
            across=min(p.across * dt, p.across_share * share * driven),
            along=min(p.along * dt, p.along_share * share * driven),
            turn=min(p.turn * dt, p.turn_share * driven),
        )

    def towards(self, at: SE2, wanted: SE2, heading: float, lateral_error: float, reach: Reach) -> SE2:
        """The pose on its way from `at` to `wanted`.

        `heading` is the path's direction here, rad: what is sideways and what is along is the path's, not that of a
        robot that swings about it, or a place put back by a metre pulls a turned robot off its line. `lateral_error`
        is the robot's distance from its path now, m, positive on its left.
        """
        c, s = math.cos(heading), math.sin(heading)
        dx, dy = wanted.x - at.x, wanted.y - at.y
        sideways = c * dy - s * dx
        aside = reach.across * (_wait(lateral_error, self.params.patience) if sideways * lateral_error > 0.0 else 1.0)
        ahead = reach.along * _wait(lateral_error, self.params.patience_along)
        along, across = _at_most(c * dx + s * dy, ahead, sideways, aside)
        turn = min(max(wrap(wanted.yaw - at.yaw), -reach.turn), reach.turn)
        return SE2(at.x + c * along - s * across, at.y + s * along + c * across, wrap(at.yaw + turn))


def _wait(lateral_error: float, patience: float) -> float:
    """Share of the reach: less the further the path runs away from the robot."""
    return max(1.0 - abs(lateral_error) / patience, 0.0)


def _at_most(along: float, ahead: float, across: float, aside: float) -> tuple[float, float]:
    """Both in the same proportion: so the path stays between the two ties in bends as well."""
    share = min(1.0, ahead / max(abs(along), 1e-9), aside / max(abs(across), 1e-9))
    return share * along, share * across
