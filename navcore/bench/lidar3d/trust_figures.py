"""How soon a wrong place on the map is noticed.

A wrong place is a recorded drive whose matches lie aside from one moment on: scored is how soon the witnesses
(`localization.map_watch`) take the trust from them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from navcore.bench.figure import Figure, share
from navcore.bench.lidar3d.localization_drive import Placed
from navcore.geometry.se2 import SE2
from navcore.localization.lidar3d.map_watch import MapWatch

NOTICED_S, WRONG_M = 1.0, (0.3, 3.0)
_SEED = 30_001


def trust_figures(drives: Sequence[list[Placed]], count: int) -> list[Figure]:
    """`count` wrong places on these drives."""
    rng = np.random.default_rng(_SEED)
    usable = [d for d in drives if sum(p.believed for p in d) > 60]
    times = [_noticed_s(usable[k % len(usable)], rng) for k in range(count)] if usable else []
    slowest = max((t for t in times if math.isfinite(t)), default=None)
    soon = sum(t <= NOTICED_S for t in times)
    return [
        share("wrong place noticed within 1.0 s", soon, len(times), seed=_SEED, at_least=1.0),
        Figure(figure="slowest to be noticed", value=slowest, unit="s", n=len(times), seed=_SEED),
    ]


def _noticed_s(placed: list[Placed], rng: np.random.Generator) -> float:
    """A drive whose matches lie aside from a moment on; s until they are not believed, infinite if never."""
    begin = int(rng.integers(20, len(placed) - 20))
    way, turn = rng.uniform(*WRONG_M), rng.uniform(-math.pi, math.pi)
    aside = SE2(way * math.cos(turn), way * math.sin(turn), rng.uniform(-0.2, 0.2))
    watch = MapWatch()
    for p in placed[:begin]:
        watch.add_match(p.match, p.T_odom_base)
    for p in placed[begin:]:
        wrong = SE2(p.match.x, p.match.y, p.match.yaw) @ aside
        if not watch.add_match(replace(p.match, x=wrong.x, y=wrong.y, yaw=wrong.yaw), p.T_odom_base):
            return (p.stamp_ns - placed[begin].stamp_ns) * 1e-9
    return math.inf
