"""The figures of `following`: how well each rival keeps the robot's place, and how long a scan takes it."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from navcore.bench.figure import Figure, share
from navcore.bench.lidar3d.following import Floats, Follower
from navcore.bench.lidar3d.ndt_rivals import OURS


def following_figures(season: str, followers: Mapping[str, Follower], seed: int) -> list[Figure]:
    """Of one season's drive; times are medians and stand over ours of the same scans."""
    return [figure for name in followers for figure in _of(season, name, followers, seed)]


def _of(season: str, name: str, followers: Mapping[str, Follower], seed: int) -> list[Figure]:
    follower, who = followers[name], f"{season}, tracking alone, {name}"
    return [
        share(f"{who}: scans until lost", follower.lost_at, len(follower.offs), seed=seed,
              at_least=1.0 if name == OURS else None),
        *_errors(who, follower.kept, seed),
        _plain(f"{who}: time of a scan over ours", _over(follower, followers[OURS]), "ratio",
               len(follower.seconds), seed),
        _plain(f"{who}: time of a scan", _median(follower.seconds, 1e3), "ms", len(follower.seconds), seed),
    ]  # fmt: skip


def _errors(who: str, kept: Floats, seed: int) -> list[Figure]:
    rows = (("lateral", kept[:, 0], "m"), ("heading", kept[:, 1] * 180.0 / math.pi, "deg"))
    return [
        _plain(f"{who}: {what} {statistic}", value(np.abs(values)) if len(values) else None, unit, len(values), seed)
        for what, values, unit in rows
        for statistic, value in (("mean", _mean), ("SD", _sd))
    ]


def _mean(values: Floats) -> float:
    return float(values.mean())


def _sd(values: Floats) -> float:
    return float(values.std())


def _median(seconds: list[float], scale: float) -> float | None:
    return scale * float(np.median(seconds)) if seconds else None


def _over(follower: Follower, ours: Follower) -> float | None:
    """Scan by scan, so that a busy moment weighs on both."""
    if not ours.seconds:
        return None
    return float(np.median(np.array(follower.seconds) / np.array(ours.seconds)))


def _plain(figure: str, value: float | None, unit: str, n: int, seed: int) -> Figure:
    return Figure(figure=figure, value=value, unit=unit, n=n, seed=seed)
