"""What stands between the trees and is neither trunk nor post: weeds and stakes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError

Floats = NDArray[np.float64]

# Own stream of randomness: what else grows on the site stays as it is without clutter.
_STREAM = 17


@dataclass(frozen=True, slots=True, kw_only=True)
class ClutterParams:
    """How much clutter; none by default. Ranges are (least, most).

    Attributes:
        weeds_per_m: bunches of weeds per metre of each line of plants, 0 to 10.
        weed_height: m, within 0.1 to 1.5.
        weed_strip: 1-sigma of a bunch's distance from its line, m, 0 to 1.
        veiled_share: share of trunks with a bunch of weeds 0.15 to 0.35 m before them, to either side, 0 to 1.
        veil_height: of those, m, within 0.1 to 1.5.
        stake_share: share of trunks with a stake beside them, 0 to 1.
        stake_radius: m, within 0.003 to 0.05; stakes are 1 to 3 cm thick.
        stake_height: above ground, m, within 0.2 to 2.5.
    """

    weeds_per_m: float = 0.0
    weed_height: tuple[float, float] = (0.2, 0.8)
    weed_strip: float = 0.15
    veiled_share: float = 0.0
    veil_height: tuple[float, float] = (0.55, 0.9)
    stake_share: float = 0.0
    stake_radius: tuple[float, float] = (0.005, 0.015)
    stake_height: tuple[float, float] = (0.6, 1.2)

    def __post_init__(self) -> None:
        bounds = {
            "weeds_per_m": (0.0, 10.0), "weed_height": (0.1, 1.5), "weed_strip": (0.0, 1.0),
            "veiled_share": (0.0, 1.0), "veil_height": (0.1, 1.5), "stake_share": (0.0, 1.0),
            "stake_radius": (0.003, 0.05), "stake_height": (0.2, 2.5),
        }  # fmt: skip
        for name, (low, high) in bounds.items():
            value = getattr(self, name)
            first, last = value if isinstance(value, tuple) else (value, value)
            if not low <= first <= last <= high:
                raise InputError(f"The clutter's {name} must lie between {low} and {high}, but is {value}.")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Clutter:
    """Arrays are float64, `map` frame, m; the ground is the plane z = 0.

    Attributes:
        weeds: (W, 4) x, y of the root, height, half width of the bunch.
        stakes: (S, 6) x, y of the foot, height, radius, and how far the top leans east and north.
    """

    weeds: Floats
    stakes: Floats


NO_CLUTTER = Clutter(weeds=np.zeros((0, 4)), stakes=np.zeros((0, 6)))


def grow_clutter(trunks: Floats, trunk_line: NDArray[np.int64], lines: Floats, params: ClutterParams,
                 seed: int) -> Clutter:  # fmt: skip
    """Clutter among trunks (T, 6) on `trunk_line` (T,) of lines (L, 4), all as in `Orchard`; same seed, same bits."""
    rng = np.random.default_rng((seed, _STREAM))
    beside = _beside_lines(lines, params, rng)
    before = _before_trunks(trunks, trunk_line, lines, params, rng)
    roots = np.concatenate((beside, before))
    height = np.concatenate(
        (rng.uniform(*params.weed_height, len(beside)), rng.uniform(*params.veil_height, len(before)))
    )
    weeds = np.column_stack((roots, height, height * rng.uniform(0.15, 0.35, len(roots))))
    return Clutter(weeds=weeds, stakes=_stakes(trunks, params, rng))


def _beside_lines(lines: Floats, params: ClutterParams, rng: np.random.Generator) -> Floats:
    """Roots (N, 2) strewn along the lines."""
    along = lines[:, 2:] - lines[:, :2]
    length = np.maximum(np.linalg.norm(along, axis=1), 1e-9)
    line = np.repeat(np.arange(len(lines)), np.rint(length * params.weeds_per_m).astype(np.int64))
    share, side = rng.uniform(0.0, 1.0, len(line)), rng.normal(0.0, params.weed_strip, len(line))
    left = np.column_stack((-along[:, 1], along[:, 0])) / length[:, None]
    return np.asarray(lines[line, :2] + share[:, None] * along[line] + side[:, None] * left[line])


def _before_trunks(
    trunks: Floats, trunk_line: NDArray[np.int64], lines: Floats, params: ClutterParams, rng: np.random.Generator
) -> Floats:
    """Roots (N, 2) before some trunks, on either side of their line."""
    veiled = np.flatnonzero(rng.random(len(trunks)) < params.veiled_share)
    away = rng.uniform(0.15, 0.35, len(veiled)) * rng.choice((-1.0, 1.0), len(veiled))
    shift = rng.normal(0.0, 0.06, len(veiled))
    along = np.concatenate((lines[:, 2:] - lines[:, :2], [(1.0, 0.0)]))[trunk_line[veiled]]
    along = along / np.maximum(np.linalg.norm(along, axis=1), 1e-9)[:, None]
    left = np.column_stack((-along[:, 1], along[:, 0]))
    return np.asarray(trunks[veiled, :2] + away[:, None] * left + shift[:, None] * along)


def _stakes(trunks: Floats, params: ClutterParams, rng: np.random.Generator) -> Floats:
    """Stakes (S, 6) driven in beside some trunks, a hand's breadth from the bark."""
    n = len(staked := np.flatnonzero(rng.random(len(trunks)) < params.stake_share))
    radius, height = rng.uniform(*params.stake_radius, n), rng.uniform(*params.stake_height, n)
    away = trunks[staked, 4] * 1.3 + radius + rng.uniform(0.02, 0.12, n)
    bearing = rng.uniform(-math.pi, math.pi, n)
    foot = trunks[staked, :2] + away[:, None] * np.column_stack((np.cos(bearing), np.sin(bearing)))
    return np.column_stack((foot, height, radius, rng.normal(0.0, 0.03, (n, 2)) * height[:, None]))
