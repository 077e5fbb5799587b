"""Paper C's fixed points: how far from the truth each way has the robot there, season by season."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from navcore.bench.figure import Figure, share
from navcore.bench.lidar3d.localization_drive import Placed
from navcore.geometry.se2 import SE2
from navcore.messages import MatchState
from navcore.sim.block_survey import fixed_points
from navcore.sim.orchard import Season
from navcore.sim.pear_block import PearBlock

# Drives of a season: the block and its turns.
Drives = dict[Season, list[tuple[PearBlock, list[Placed]]]]
SEASONS = {Season.DORMANT: "winter", Season.BUDDING: "spring", Season.GROWING: "full leaf"}
WAYS = {"rtk": "RTK alone", "map": "3D map alone", "fused": "both, as driven"}
# Paper C at 1.0 m/s, lateral m and heading deg: RTK alone, and with NDT; what is wanted of ours.
PAPER = {"lateral mean": 0.05, "lateral SD": 0.02, "heading mean": 1.0, "heading SD": 0.6}
WANTED = {"lateral mean": 0.02, "lateral SD": 0.01, "heading mean": 0.3, "heading SD": 0.2}
DRIVE_SEED = 20_001


def season_figures(
    season: str, drives: Sequence[tuple[PearBlock, list[Placed]]], rows: tuple[int, ...]
) -> list[Figure]:  # fmt: skip
    """Errors at the fixed points of one season, RTK and the map alone beside both."""
    errors = {way: at_fixed_points(drives, rows, way) for way in ("fused", "rtk", "map")}
    figures = []
    for name, paper in PAPER.items():
        told = {way: _statistic(name, found) for way, found in errors.items()}
        value, unit = told["fused"], "m" if name.startswith("lateral") else "deg"
        figures.append(Figure(
            figure=f"{season}: {name} at the fixed points", value=value, unit=unit, n=len(errors["fused"]),
            seed=DRIVE_SEED, paper=paper, baseline=told["rtk"], target=WANTED[name],
            ok=None if value is None else value <= WANTED[name],
        ))  # fmt: skip
        figures.append(Figure(
            figure=f"{season}: {name}, the map alone", value=told["map"], unit=unit, n=len(errors["map"]),
            seed=DRIVE_SEED, paper=paper, baseline=told["rtk"],
        ))  # fmt: skip
    whole = sum(len(fixed_points(tuple(block.site.rows[i] for i in rows))) for block, _ in drives)
    figures.append(share(f"{season}: fixed points with a place", len(errors["fused"]), whole, seed=DRIVE_SEED))
    return figures


def at_fixed_points(
    drives: Sequence[tuple[PearBlock, list[Placed]]], rows: tuple[int, ...], way: str
) -> list[tuple[float, float]]:  # fmt: skip
    """(lateral, heading) error where the robot truly passes each point, m and rad."""
    found = []
    for block, placed in drives:
        for point in fixed_points(tuple(block.site.rows[i] for i in rows)):
            nearest = min(placed, key=lambda p: math.hypot(p.truth.x - point.x, p.truth.y - point.y))
            told = _told(nearest, way)
            if told is not None:
                off = nearest.truth.inverse() @ told
                found.append((off.y, off.yaw))
    return found


def _told(placed: Placed, way: str) -> SE2 | None:
    if way != "map":
        return placed.fused if way == "fused" else placed.rtk
    match = placed.match
    return SE2(match.x, match.y, match.yaw) if match.state is MatchState.MATCHED else None


def _statistic(name: str, errors: list[tuple[float, float]]) -> float | None:
    if not errors:
        return None
    which, scale = (0, 1.0) if name.startswith("lateral") else (1, 180.0 / math.pi)
    values = scale * np.array(errors)[:, which]
    return float(np.abs(values).mean() if name.endswith("mean") else np.abs(values).std())
