"""Rays to whole turns of the sensor, each ray with its time."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.drivers.rplidar.rays import Floats, Ints, Rays
from navcore.messages import LidarScan

# Rays of a device that never comes round are not kept for ever.
MOST_RAYS = 32_768


@dataclass(frozen=True, slots=True, eq=False)
class Revolution:
    """One turn.

    Attributes:
        rays: of the turn, in the order in which they were taken.
        stamps_ns: (N,) when each was taken.
    """

    rays: Rays
    stamps_ns: NDArray[np.int64]

    def scan(self) -> LidarScan:
        """As a message; ranges to a tenth of a millimetre, bearings to a hundred-thousandth of a radian."""
        return LidarScan(
            stamp_ns=int(self.stamps_ns[-1]), began_ns=int(self.stamps_ns[0]),
            angles=tuple(np.round(self.rays.angle, 5).tolist()),
            distances=tuple(np.round(self.rays.distance, 4).tolist()),
        )  # fmt: skip


class Revolutions:
    """Gathers rays until the sensor has come round; what came before the first full turn is not told."""

    def __init__(self) -> None:
        self._angle: list[Floats] = []
        self._distance: list[Floats] = []
        self._quality: list[Ints] = []
        self._count = 0
        self._turned: float | None = None
        self._furthest = 0.0
        self._began_ns: int | None = None

    def add(self, rays: Rays, stamp_ns: int) -> list[Revolution]:
        """Turns that are complete with rays that arrived at `stamp_ns`."""
        found, at = [], 0
        for begin in self._begins(rays.angle):
            self._keep(rays, at, begin)
            turn = self._close(stamp_ns)
            if turn is not None:
                found.append(turn)
            at = begin
        self._keep(rays, at, len(rays.angle))
        if self._count > MOST_RAYS:
            self._forget(None)
        return found

    def _begins(self, angle: Floats) -> list[int]:
        """Where rays begin a new turn. The furthest one counts: near objects make rays point back by some degrees."""
        if not len(angle):
            return []
        before = -angle[0] if self._turned is None else self._turned
        steps = np.diff(-angle, prepend=before)
        turned = before + np.cumsum(steps - math.tau * np.round(steps / math.tau))
        furthest = np.maximum.accumulate(np.append(max(self._furthest, before), turned))
        self._turned, self._furthest = float(turned[-1]), float(furthest[-1])
        return [int(i) for i in np.flatnonzero(np.diff(np.floor(furthest / math.tau)))]

    def _keep(self, rays: Rays, begin: int, end: int) -> None:
        if end > begin:
            self._angle.append(rays.angle[begin:end])
            self._distance.append(rays.distance[begin:end])
            self._quality.append(rays.quality[begin:end])
            self._count += end - begin

    def _close(self, stamp_ns: int) -> Revolution | None:
        """The turn so far, None if its beginning was not seen. Its rays were taken evenly since that moment."""
        began, n = self._began_ns, self._count
        turn = None
        if began is not None and n:
            rays = Rays(np.concatenate(self._angle), np.concatenate(self._distance), np.concatenate(self._quality))
            stamps = stamp_ns - ((stamp_ns - began) * (n - 1 - np.arange(n))) // n
            turn = Revolution(rays, stamps.astype(np.int64))
        self._forget(stamp_ns)
        return turn

    def _forget(self, began_ns: int | None) -> None:
        self._angle, self._distance, self._quality = [], [], []
        self._count, self._began_ns = 0, began_ns
