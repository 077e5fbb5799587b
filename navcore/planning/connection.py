"""The cheapest free way from one of several poses to one of several others."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se2 import SE2
from navcore.planning.dubins import DubinsPath, dubins_paths

Floats = NDArray[np.float64]
Blocked = Callable[[Floats], tuple[int, str] | None]

# Cost of each metre of radius given away, m of way: wide turns are driven truer.
_TIGHTNESS = 1.0
# Most ways that are not free show it at bodies this far apart, m.
_COARSE = 3.0
# So much way is checked at most: what stands across long ways stands across all of them, m.
_MOST_CHECKED = 30_000.0


@dataclass(frozen=True, slots=True)
class Option:
    """A pose that a way may begin or end at.

    Attributes:
        cost: what choosing it costs, as metres of way.
        key: what it stands for, for the caller.
    """

    pose: SE2
    cost: float
    key: float


@dataclass(frozen=True, slots=True)
class Connection:
    """A way between two of the options. `obstacle` is empty if it is free, else what the cheapest way meets where."""

    start: Option
    goal: Option
    path: DubinsPath
    obstacle: str = ""
    place: tuple[float, float] = (0.0, 0.0)


def connect(
    starts: Iterable[Option], goals: Iterable[Option], radii: tuple[float, ...], blocked: Blocked, *,
    step: float = 0.3, longest: float = 30.0, tries: int = 200,
) -> Connection:  # fmt: skip
    """The cheapest free connection by arcs and straights; if none is free, the cheapest of all with its obstacle.

    Args:
        radii: of the arcs, widest first.
        blocked: first of poses (N, 3) where the body must not be, and what is there.
        longest: detours that are this much longer than the shortest way are not tried, m.
        tries: so many ways are checked at most.

    Raises ValueError without options.
    """
    ranked = sorted(_candidates(list(starts), list(goals), radii), key=lambda c: c[0])
    best: Connection | None = None
    checked = 0.0
    for cost, start, goal, path in ranked[:tries]:
        if cost > ranked[0][0] + longest or checked > _MOST_CHECKED:
            break
        checked += path.length
        if best is not None and blocked(path.poses(_COARSE)) is not None:
            continue
        poses = path.poses(step)
        hit = blocked(poses)
        if hit is None:
            return Connection(start, goal, path)
        if best is None:
            x, y = poses[hit[0], :2]
            best = Connection(start, goal, path, hit[1], (float(x), float(y)))
    if best is None:
        raise ValueError("no options to connect")
    return best


def _candidates(
    starts: list[Option], goals: list[Option], radii: tuple[float, ...]
) -> Iterable[tuple[float, Option, Option, DubinsPath]]:
    for start in starts:
        for goal in goals:
            for radius in radii:
                extra = start.cost + goal.cost + _TIGHTNESS * (radii[0] - radius)
                for path in dubins_paths(start.pose, goal.pose, radius):
                    yield path.length + extra, start, goal, path
