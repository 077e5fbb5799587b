"""Where on a whole map a cloud could have been taken: what stands in it is slid over the map seen from above.

All shifts of one heading are weighed at once by their correlation (Fourier); headings follow one another. It is a
coarse look, which tells where to match (Olson, Real-time correlative scan matching, 2009, has the idea of two
resolutions).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.fft import irfft2, next_fast_len, rfft2
from scipy.ndimage import maximum_filter

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2
from navcore.localization.ndt.birds_eye import BirdsEye

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Region:
    """Where the robot may be: within `reach`, m, of a place and within `turn`, rad, of its direction."""

    at: SE2
    reach: float
    turn: float = math.pi

    def holds(self, place: SE2, more: float = 0.0, more_turn: float = 0.0) -> bool:
        """Whether a place lies in it, or by so much beside it."""
        away = math.hypot(place.x - self.at.x, place.y - self.at.y)
        return away <= self.reach + more and abs(wrap(place.yaw - self.at.yaw)) <= self.turn + more_turn


@dataclass(frozen=True, slots=True, kw_only=True)
class PlaceSearchParams:
    """Parameters of `PlaceSearch`.

    Attributes:
        reach: of the cloud's points that count, m: farther ones smear over a heading's step.
        low, high: heights above the ground of those, m.
        full: so many points in a pixel count as one that is full.
        turn_step: between headings, rad. sectors: in each of which places are kept apart from those of the others.
        apart: pixels between two places of a sector.
        share: of the best that a place must fit. most: places, the best.
        pixels: that one `step` transforms, about: it bounds its time (a million takes some 50 ms).
    """

    reach: float = 25.0
    low: float = 0.5
    high: float = 3.0
    full: int = 3
    turn_step: float = math.radians(3.0)
    sectors: int = 12
    apart: int = 2
    share: float = 0.8
    most: int = 100
    pixels: int = 800_000


class PlaceSearch:
    """Call `step` until it is done; the work is divided so that each takes about the same time.

    Attributes:
        eye: the part of the map that is looked at.

    Args:
        eye: the map from above.
        points: (N, 3) in the robot's frame made level, z up from the ground, m.
        region: where to look; everywhere if None.
    """

    def __init__(
        self,
        eye: BirdsEye,
        points: Floats,
        region: Region | None = None,
        params: PlaceSearchParams = PlaceSearchParams(),
    ) -> None:
        self._p, self._region = params, region
        near = eye if region is None else eye.near(region.at.x, region.at.y, region.reach + params.reach)
        self.eye = near or BirdsEye(
            size=eye.size, corner=eye.corner, upright=np.zeros((1, 1)), ground=np.zeros((1, 1))
        )
        seen = (points[:, 2] > params.low) & (points[:, 2] < params.high)
        self._points = points[seen & (np.hypot(points[:, 0], points[:, 1]) < params.reach), :2]
        self._half = math.ceil(params.reach / eye.size) + 1
        self._shape = tuple(next_fast_len(n + 2 * self._half, real=True) for n in self.eye.upright.shape)
        self._map = rfft2(self.eye.upright, self._shape)
        self._headings = self._all_headings()
        self._next = 0
        self._best = np.zeros((params.sectors, *self.eye.upright.shape), dtype=np.float32)
        self._by = np.zeros(self._best.shape, dtype=np.int16)

    @property
    def done(self) -> bool:
        """All headings were looked at."""
        return self._next >= len(self._headings)

    def step(self) -> None:
        """Look at the next headings."""
        at_once = max(1, self._p.pixels // (self._shape[0] * self._shape[1]))
        for number in range(self._next, min(self._next + at_once, len(self._headings))):
            self._look(number, self._headings[number])
        self._next += at_once

    def places(self) -> list[SE2]:
        """Of `base_link` in the map's frame, the one that fits best first."""
        peaks = self._best * (self._best == maximum_filter(self._best, (1, *[2 * self._p.apart + 1] * 2)))
        peaks *= self._inside()
        best = np.argsort(-peaks, axis=None, kind="stable")[: self._p.most]
        least = self._p.share * float(peaks.max(initial=0.0))
        where = np.unravel_index(best, peaks.shape)
        size, (x, y) = self.eye.size, self.eye.corner
        return [
            SE2(x + (i + 0.5) * size, y + (j + 0.5) * size, wrap(float(self._headings[self._by[k, i, j]])))
            for k, i, j in zip(*where, strict=True)
            if peaks[k, i, j] >= max(least, 1e-6)
        ]

    def _all_headings(self) -> Floats:
        step, region = self._p.turn_step, self._region
        if region is None or region.turn >= math.pi - step:
            return np.asarray(np.arange(round(2.0 * math.pi / step)) * step, dtype=np.float64)
        reach = math.ceil(region.turn / step)
        return np.asarray(region.at.yaw + np.arange(-reach, reach + 1) * step, dtype=np.float64)

    def _look(self, number: int, heading: float) -> None:
        """A pixel's worth is the mean of the map under the cloud's points if the robot stood in it."""
        c, s, half = math.cos(heading), math.sin(heading), self._half
        turned = self._points @ np.array(((c, s), (-s, c)))
        i, j = np.floor(turned / self.eye.size + 0.5).astype(np.int64).T + half
        seen = np.zeros((2 * half + 1, 2 * half + 1))
        np.add.at(seen, (i, j), 1.0)
        seen = np.minimum(seen, self._p.full)
        met = irfft2(self._map * np.conj(rfft2(seen, self._shape)), self._shape)
        rows, columns = self.eye.upright.shape
        worth = np.roll(met, (half, half), (0, 1))[:rows, :columns] / max(float(seen.sum()), 1.0)
        sector = int(heading % (2.0 * math.pi) / (2.0 * math.pi) * self._p.sectors) % self._p.sectors
        better = worth > self._best[sector]
        self._best[sector][better] = worth[better]
        self._by[sector][better] = number

    def _inside(self) -> NDArray[np.bool_]:
        rows, columns = self.eye.upright.shape
        if self._region is None:
            return np.ones((rows, columns), dtype=bool)
        x = self.eye.corner[0] + (np.arange(rows) + 0.5) * self.eye.size - self._region.at.x
        y = self.eye.corner[1] + (np.arange(columns) + 0.5) * self.eye.size - self._region.at.y
        return np.asarray(np.hypot(x[:, None], y[None, :]) <= self._region.reach + self.eye.size)
