"""Odometry and IMU of the last seconds, as the motion during a scan."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import dataclass

import numpy as np

from navcore.errors import ConfigError, NotFiniteError
from navcore.localization.motion_track import NS, MotionTrack
from navcore.messages import ImuSample

Rates = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionHistoryParams:
    """Parameters of `MotionHistory`.

    Attributes:
        kept_s: how far back a scan may begin, 0.2 to 60 s.
        silent_s: wheels that have told nothing for so long before a scan's end are not known to stand or to drive,
            0.05 to 1 s. Without gyro samples for so long, the wheels' turn rate takes its place.
        wheel_turn_ratio: by how much skid-steered wheels over-read a turn, 1 to 3; 1.6 as in `DeadReckoningParams`.
    """

    kept_s: float = 2.0
    silent_s: float = 0.2
    wheel_turn_ratio: float = 1.6

    def __post_init__(self) -> None:
        if not (0.2 <= self.kept_s <= 60 and 0.05 <= self.silent_s <= 1 and 1 <= self.wheel_turn_ratio <= 3):
            raise ConfigError("A value of MotionHistoryParams is out of its bounds; its docstring names them.")


class MotionHistory:
    """Takes samples in the order of their stamps; one that is no newer than the last of its kind is left out."""

    def __init__(self, params: MotionHistoryParams = MotionHistoryParams()) -> None:
        self._p = params
        self._wheels: list[tuple[int, float, float]] = []
        self._gyro: list[tuple[int, Rates]] = []

    def add_wheels(self, stamp_ns: int, v: float, omega: float) -> None:
        """Measured speed, m/s, and turn rate of the wheels, rad/s. Raises NotFiniteError."""
        _refuse_nan(v, omega)
        if not self._wheels or stamp_ns > self._wheels[-1][0]:
            self._wheels.append((stamp_ns, v, omega))
            _prune(self._wheels, stamp_ns - round(self._p.kept_s / NS))

    def add_imu(self, sample: ImuSample) -> None:
        """Measured turn rates in `base_link`. Raises NotFiniteError."""
        _refuse_nan(sample.wx, sample.wy, sample.wz)
        if not self._gyro or sample.stamp_ns > self._gyro[-1][0]:
            self._gyro.append((sample.stamp_ns, (sample.wx, sample.wy, sample.wz)))
            _prune(self._gyro, sample.stamp_ns - round(self._p.kept_s / NS))

    def track(self, began_ns: int, ended_ns: int) -> MotionTrack | None:
        """The motion from before the one time, if it is known so far back, to the other or the newest sample after
        it; None where the wheels tell too little.
        """
        if not self._wheels or ended_ns - self._wheels[-1][0] > round(self._p.silent_s / NS):
            return None
        samples = _around(self._gyro, began_ns, ended_ns)
        if len(samples) < 2 or ended_ns - samples[-1][0] > round(self._p.silent_s / NS):
            samples = self._turned_by_wheels(began_ns, ended_ns)
        if len(samples) < 2:
            return None
        stamps = [stamp for stamp, _ in samples]
        return MotionTrack.of_rates(stamps, self._speeds(stamps), [rates for _, rates in samples])

    def _turned_by_wheels(self, began_ns: int, ended_ns: int) -> list[tuple[int, Rates]]:
        ratio = self._p.wheel_turn_ratio
        turned = [(stamp, (0.0, 0.0, omega / ratio)) for stamp, _, omega in self._wheels]
        return _around(turned, began_ns, ended_ns)

    def _speeds(self, stamps_ns: list[int]) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        """Between the wheels' samples; before and after them as the nearest."""
        first = stamps_ns[0]
        known = [(stamp - first) * NS for stamp, _, _ in self._wheels]
        wanted = [(stamp - first) * NS for stamp in stamps_ns]
        return np.interp(wanted, known, [v for _, v, _ in self._wheels])


def _around(samples: list[tuple[int, Rates]], began_ns: int, ended_ns: int) -> list[tuple[int, Rates]]:
    """Those within, and one on either side."""
    begin = bisect_right(samples, began_ns, key=lambda sample: sample[0]) - 1
    end = bisect_left(samples, ended_ns, key=lambda sample: sample[0]) + 1
    return samples[max(begin, 0) : end]


def _prune(samples: list[tuple[int, Rates]] | list[tuple[int, float, float]], oldest_ns: int) -> None:
    """In portions, so that the lists are not moved at every sample."""
    drop = bisect_left(samples, oldest_ns, key=lambda sample: sample[0])
    if drop > len(samples) // 2:
        del samples[:drop]


def _refuse_nan(*values: float) -> None:
    if not np.all(np.isfinite(values)):
        raise NotFiniteError("A speed or turn rate of the robot is not finite; leave it out.")
