"""A drive with known truth, run through the pose filter."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from navcore.localization.gnss_correction import GnssCorrectionParams
from navcore.localization.pose_filter import PoseFilter, PoseFilterParams
from navcore.messages import GnssFix, ImuSample, PoseEstimate
from tests.navcore.localization.drive import (
    FRAME,
    SECOND,
    START_NS,
    Drive,
    Errors,
    Message,
    Profile,
    winding,
)

Change = Callable[[GnssFix, float], GnssFix | None]
PARAMS = PoseFilterParams(gnss=GnssCorrectionParams(antenna_x=0.2))


@dataclass
class Result:
    """Errors of the estimate at every chassis tick after the start; x, y in m, yaw in rad."""

    filter: PoseFilter
    t: list[float]
    estimates: list[PoseEstimate]
    errors: list[tuple[float, float, float]]

    def worst(self, start_s: float = 0.0, end_s: float = 1e9) -> float:
        """Largest position error in a stretch of time, m."""
        return max(math.hypot(e[0], e[1]) for t, e in zip(self.t, self.errors, strict=True) if start_s <= t < end_s)

    def worst_yaw(self, start_s: float = 0.0) -> float:
        """Largest heading error, rad."""
        return max(abs(e[2]) for t, e in zip(self.t, self.errors, strict=True) if t >= start_s)

    def nees(self) -> list[float]:
        """Normalised squared errors of (x, y, yaw), once a second."""
        found = []
        for estimate, error in list(zip(self.estimates, self.errors, strict=True))[::50]:
            covariance = np.array(estimate.covariance).reshape(3, 3)
            found.append(float(np.array(error) @ np.linalg.solve(covariance, np.array(error))))
        return found


def feed(pose_filter: PoseFilter, message: Message) -> None:
    if isinstance(message, ImuSample):
        pose_filter.add_imu(message)
    elif isinstance(message, GnssFix):
        pose_filter.add_gnss(message)
    else:
        pose_filter.add_chassis(message)


def drive(
    seed: int = 1, seconds: float = 30.0, profile: Profile = winding, change: Change | None = None,
    errors: Errors | None = None, imu: bool = True,
) -> Result:  # fmt: skip
    world = Drive(seed, profile, errors)
    result = Result(PoseFilter(FRAME, PARAMS), [], [], [])
    for now_ns, message in world.run(seconds, change):
        if imu or not isinstance(message, ImuSample):
            feed(result.filter, message)
        estimate = result.filter.estimate(now_ns)
        if isinstance(message, ImuSample | GnssFix) or estimate is None:
            continue
        true = world.truth[-1]
        error = (estimate.x - true.x, estimate.y - true.y, math.remainder(estimate.yaw - true.yaw, 2 * math.pi))
        result.t.append((now_ns - START_NS) / SECOND)
        result.estimates.append(estimate)
        result.errors.append(error)
    return result
