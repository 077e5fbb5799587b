"""Drives that compare controllers: which one, on which way, how fast, and who tells it where it is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from itertools import product

from navcore.bench.tracking.courses import Course
from navcore.config import RobotConfig
from navcore.control.lqr_tracker import LqrTrackerParams
from navcore.control.tracking import TrackerName, TrackingParams

VEHICLE = "scout_2"  # paper C's
SPEEDS = (0.5, 1.0, 1.5)
# Gains and look-aheads were chosen on the tuning seeds, and on nothing else; the figures come from the scoring seeds.
TUNING_SEEDS, SCORING_SEEDS = range(1001, 1021), range(1, 21)


class Rival(StrEnum):
    """Who follows the line.

    PUBLISHED: paper C's. LINE, ADAPTIVE, LQR: ours. NO_DELAY, NO_SLIP: `LQR` that knows nothing of dead time and lag,
    or nothing of what pushes the robot round.
    """

    PUBLISHED = "pure pursuit as published"
    LINE = "pursuit, look-ahead of paper A"
    ADAPTIVE = "pursuit, adaptive look-ahead"
    LQR = "LQR"
    NO_DELAY = "LQR without delay compensation"
    NO_SLIP = "LQR without slip feed-forward"


class Localization(StrEnum):
    """Who tells the robot where it is: the world itself, or the pose filter with RTK GNSS in the open."""

    TRUE = "true pose"
    RTK = "RTK GNSS"


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackingCase:
    """One drive; `speed` in m/s."""

    rival: Rival
    localization: Localization
    course: Course
    speed: float
    seed: int

    def config(self) -> RobotConfig:
        """The robot's settings."""
        shipped = RobotConfig(vehicle=VEHICLE)
        driver = replace(shipped.navigator.driver, tracking=_TRACKING[self.rival])
        return replace(shipped, navigator=replace(shipped.navigator, driver=driver))


@dataclass(frozen=True, slots=True, kw_only=True)
class TrackingCaseParams:
    """Which drives.

    Attributes:
        alone: who drives with the true pose, on `alone_seeds`. by_rtk: with RTK GNSS, on `rtk_seeds`.
    """

    alone: tuple[Rival, ...] = tuple(Rival)
    by_rtk: tuple[Rival, ...] = (Rival.PUBLISHED, Rival.LINE, Rival.LQR)
    alone_seeds: tuple[int, ...] = tuple(SCORING_SEEDS)
    rtk_seeds: tuple[int, ...] = tuple(SCORING_SEEDS)
    speeds: tuple[float, ...] = SPEEDS


QUICK = TrackingCaseParams(
    alone=(Rival.PUBLISHED, Rival.LINE, Rival.LQR), by_rtk=(Rival.LQR,), alone_seeds=(1, 2), rtk_seeds=(1,)
)


def tracking_cases(params: TrackingCaseParams) -> tuple[TrackingCase, ...]:
    """All drives, seed by seed, so that a bench that is broken off has something of everyone."""
    parts = (
        (Localization.TRUE, params.alone, params.alone_seeds),
        (Localization.RTK, params.by_rtk, params.rtk_seeds),
    )
    cases = [
        TrackingCase(rival=rival, localization=localization, course=course, speed=speed, seed=seed)
        for localization, rivals, seeds in parts
        for seed, rival, course, speed in product(seeds, rivals, Course, params.speeds)
    ]
    return tuple(sorted(cases, key=lambda case: case.seed))


_NO_DELAY = LqrTrackerParams(delay_known=False)
_NO_SLIP = LqrTrackerParams(push_known=False)
_TRACKING = {
    Rival.PUBLISHED: TrackingParams(name=TrackerName.PUBLISHED),
    Rival.LINE: TrackingParams(name=TrackerName.LINE),
    Rival.ADAPTIVE: TrackingParams(name=TrackerName.ADAPTIVE),
    Rival.LQR: TrackingParams(name=TrackerName.LQR),
    Rival.NO_DELAY: TrackingParams(name=TrackerName.LQR, lqr=_NO_DELAY),
    Rival.NO_SLIP: TrackingParams(name=TrackerName.LQR, lqr=_NO_SLIP),
}
SHIPPED = next(rival for rival, tracking in _TRACKING.items() if tracking == TrackingParams())
