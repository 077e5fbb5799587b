"""Whether the receiver has RTK fixed, float, single or nothing, and how wrong it is then."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.messages import FixQuality

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class RtkSolverParams:
    """Rules and error levels. Chosen so that the mechanism shows; not calibrated against a real receiver.

    Attributes:
        open_sky_db_hz: C/N0 at the horizon; 10 dB more at the zenith.
        use_db_hz: a satellite below this is not tracked.
        clean_loss_db, clean_jump_db, clean_db_hz: a carrier phase is clean below this loss, below this jump from
            epoch to epoch (cycle slips), above this C/N0.
        clean_needed, clean_hdop: an epoch is good for RTK with so many clean satellites and such geometry.
        hold_s: a fix survives bad epochs for so long.
        refix_s: least and most clean time until the next fix.
        fixed, floating, single: (white 1-sigma m, correlated 1-sigma m, correlation time s), horizontal, at HDOP 1;
            vertical is 1.6 times as bad.
        believed_share: what the receiver believes of its float and single errors; real ones are optimistic too.
        false_fix_share: share of fixes won with fewer than `false_fix_satellites` clean satellites that are wrong,
            by `false_fix_m` (least, most), for `false_fix_s` (least, most).
        correction_float_s, correction_lost_s: age of corrections that ends the fix and the float solution.
    """

    open_sky_db_hz: float = 38.0
    use_db_hz: float = 32.0
    clean_loss_db: float = 3.0
    clean_jump_db: float = 2.0
    clean_db_hz: float = 36.0
    clean_needed: int = 8
    clean_hdop: float = 1.8
    hold_s: float = 1.5
    refix_s: tuple[float, float] = (4.0, 9.0)
    fixed: tuple[float, float, float] = (0.008, 0.006, 30.0)
    floating: tuple[float, float, float] = (0.06, 0.35, 40.0)
    single: tuple[float, float, float] = (0.5, 1.0, 60.0)
    believed_share: float = 0.6
    false_fix_share: float = 0.03
    false_fix_satellites: int = 12
    false_fix_m: tuple[float, float] = (0.1, 0.4)
    false_fix_s: tuple[float, float] = (3.0, 8.0)
    correction_float_s: float = 20.0
    correction_lost_s: float = 60.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RtkSolution:
    """Outcome of one epoch.

    Attributes:
        satellites: used; `clean` of them with a clean carrier phase.
        error_m: true error east, north, up.
        std_m: 1-sigma as the receiver believes.
    """

    quality: FixQuality
    satellites: int
    clean: int
    hdop: float
    error_m: tuple[float, float, float]
    std_m: tuple[float, float, float]


class RtkSolver:
    """Fix, float, single, none: a state machine over the satellites' losses (after the prototype's rules)."""

    def __init__(self, params: RtkSolverParams, rng: np.random.Generator, *, cold_start: bool) -> None:
        self._params, self._rng = params, rng
        self._quality = FixQuality.SINGLE
        self._good_s, self._bad_s = (0.0 if cold_start else math.inf), 0.0
        self._needed_s = params.refix_s[1]
        self._bias = np.zeros(3)
        self._false_bias, self._false_left_s = np.zeros(3), 0.0
        self._last_loss: Floats = np.zeros(0)

    def update(self, dt_s: float, towards: Floats, loss_db: Floats, correction_age_s: float) -> RtkSolution:
        """The epoch `dt_s` after the last one, from unit vectors (N, 3) to the satellites and their losses (N,)."""
        p = self._params
        elevation_gain = 10.0 * towards[:, 2] ** 0.7
        cn = p.open_sky_db_hz + elevation_gain - loss_db + 0.7 * self._rng.standard_normal(len(towards))
        jump = np.abs(loss_db - self._last_loss) if len(self._last_loss) == len(loss_db) else np.zeros(len(loss_db))
        self._last_loss = loss_db
        used = cn > p.use_db_hz
        clean = used & (loss_db < p.clean_loss_db) & (jump < p.clean_jump_db) & (cn > p.clean_db_hz)
        hdop = _hdop(towards[used], cn[used])
        self._judge(dt_s, int(used.sum()), int(clean.sum()), hdop, correction_age_s)
        dirty = 1.0 + 1.5 * (1.0 - float(clean.mean()))
        error, std = self._errors(dt_s, max(min(hdop, 2.5), 0.6), dirty)
        return RtkSolution(
            quality=self._quality, satellites=int(used.sum()), clean=int(clean.sum()), hdop=hdop, error_m=error,
            std_m=std,
        )  # fmt: skip

    def lose_everything(self) -> RtkSolution:
        """An epoch without a single satellite."""
        self._quality, self._good_s, self._bad_s = FixQuality.NONE, 0.0, math.inf
        return RtkSolution(
            quality=FixQuality.NONE, satellites=0, clean=0, hdop=99.9, error_m=(0.0,) * 3, std_m=(99.0,) * 3
        )

    def _judge(self, dt_s: float, used: int, clean: int, hdop: float, age_s: float) -> None:
        p, before = self._params, self._quality
        good = clean >= p.clean_needed and hdop < p.clean_hdop and age_s < p.correction_float_s
        self._good_s, self._bad_s = (self._good_s + dt_s, 0.0) if good else (0.0, self._bad_s + dt_s)
        self._quality = self._next(used, clean, hdop, age_s)
        if before is FixQuality.RTK_FIXED and self._quality is not before:
            self._needed_s = self._rng.uniform(*p.refix_s)
        if self._quality is FixQuality.RTK_FIXED and before is not self._quality:
            self._maybe_false(clean)

    def _next(self, used: int, clean: int, hdop: float, age_s: float) -> FixQuality:
        p = self._params
        if used < 5:
            return FixQuality.NONE
        if age_s > p.correction_lost_s or used < 7 or hdop > 3.0 or clean < 3:
            return FixQuality.SINGLE
        if self._quality is FixQuality.RTK_FIXED and self._bad_s < p.hold_s:
            return FixQuality.RTK_FIXED
        return FixQuality.RTK_FIXED if self._good_s > self._needed_s else FixQuality.RTK_FLOAT

    def _maybe_false(self, clean: int) -> None:
        """A fix won under a poor sky may rest on wrong integers."""
        p, draw = self._params, self._rng.random(4)
        self._false_left_s = 0.0
        if clean < p.false_fix_satellites and draw[0] < p.false_fix_share:
            size = p.false_fix_m[0] + draw[1] * (p.false_fix_m[1] - p.false_fix_m[0])
            heading = 2.0 * math.pi * draw[2]
            self._false_bias = size * np.array((math.cos(heading), math.sin(heading), 1.0))
            self._false_left_s = p.false_fix_s[0] + draw[3] * (p.false_fix_s[1] - p.false_fix_s[0])

    def _errors(
        self, dt_s: float, dilution: float, dirty: float
    ) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """True error and believed 1-sigma: white noise and a correlated bias that forgets slowly."""
        p, fixed = self._params, self._quality is FixQuality.RTK_FIXED
        levels = p.fixed if fixed else p.floating if self._quality is FixQuality.RTK_FLOAT else p.single
        white, correlated, tau = levels[0] * dilution, levels[1] * dilution * dirty, levels[2]
        f = math.exp(-dt_s / tau)
        vertical = np.array((1.0, 1.0, 1.6))
        normals = self._rng.standard_normal((2, 3))
        self._bias = self._bias * f + math.sqrt(1.0 - f * f) * correlated * vertical * normals[0]
        self._bias *= min(1.0, 3.2 * correlated / max(float(np.linalg.norm(self._bias[:2])), 1e-9))
        error = self._bias + white * vertical * normals[1]
        if fixed and self._false_left_s > 0.0:
            self._false_left_s -= dt_s
            error = error + self._false_bias
            if self._false_left_s <= 0.0:
                self._quality, self._good_s = FixQuality.RTK_FLOAT, 0.0
        std = math.hypot(white, correlated) * (1.0 if fixed else p.believed_share)
        return (float(error[0]), float(error[1]), float(error[2])), (std, std, 1.6 * std)


def _hdop(towards: Floats, cn: Floats) -> float:
    """Horizontal dilution of precision, satellites weighted by their C/N0; 99.9 without a solution."""
    if len(towards) < 4:
        return 99.9
    G = np.column_stack((towards, np.ones(len(towards))))
    weights = 10.0 ** ((cn - 45.0) / 20.0)
    normal = (G.T * weights) @ G
    if np.linalg.cond(normal) > 1e8:
        return 99.9
    Q = np.linalg.inv(normal)
    return float(min(math.sqrt(Q[0, 0] + Q[1, 1]), 99.9))
