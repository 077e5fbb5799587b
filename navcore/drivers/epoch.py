"""One receiver epoch, put together from the sentences that describe it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from navcore.drivers.epoch_part import EpochPart
from navcore.geometry.angles import wrap
from navcore.messages import FixQuality, GnssFix

SAME_PLACE_DEG = 2e-5
"""About 2 m: sentences of one epoch differ only by their rounding."""


@dataclass(frozen=True, slots=True, kw_only=True)
class BaselineMount:
    """How the antenna baseline lies in the robot.

    Attributes:
        yaw_rad: direction from the master to the slave antenna in `base_link`, counter-clockwise from x, (-pi, pi].
    """

    yaw_rad: float = 0.0


class Epoch:
    """Collects parts; the position of the highest rank counts, other fields come from whoever told them first."""

    def __init__(self, arrival_ns: int, offset: int) -> None:
        self.arrival_ns = arrival_ns
        self.last_arrival_ns = arrival_ns
        self.offset = offset
        self.parts: dict[str, EpochPart] = {}

    @property
    def clock_ns(self) -> int | None:
        """UTC time of day, None until a sentence told it."""
        return next((p.clock_ns for p in self.parts.values() if p.clock_ns is not None), None)

    @property
    def last_kind(self) -> str:
        """Kind of the newest part."""
        return next(reversed(self.parts))

    def add(self, part: EpochPart, arrival_ns: int) -> None:
        """Take a part that belongs to this epoch."""
        self.parts.setdefault(part.kind, part)
        self.last_arrival_ns = arrival_ns

    def drop_disagreeing(self) -> list[str]:
        """Forget the parts that put the antenna elsewhere than the part of the highest rank; their kinds."""
        best = self._best()
        wrong = [] if best is None else [k for k, p in self.parts.items() if not _same_place(p, best)]
        for kind in wrong:
            del self.parts[kind]
        return wrong

    def fix(self, stamp_ns: int, utc_ns: int | None, mount: BaselineMount) -> GnssFix:
        """The epoch as one fix."""
        quality, best = self._quality(), self._best()
        located = best if quality is not FixQuality.NONE else None
        heading_rad, heading_std_rad = self._heading(mount)
        course_deg = self._first("course_deg")
        return GnssFix(
            stamp_ns=stamp_ns,
            utc_s=None if utc_ns is None else utc_ns / 1e9,
            quality=quality,
            lat_deg=located.lat_deg if located else None,
            lon_deg=located.lon_deg if located else None,
            height_m=self._first("height_m") if located else None,
            std_east_m=self._first("std_east_m"),
            std_north_m=self._first("std_north_m"),
            std_up_m=self._first("std_up_m"),
            heading_rad=heading_rad,
            heading_std_rad=heading_std_rad,
            speed=self._first("speed"),
            course_rad=None if course_deg is None else yaw_of_bearing(course_deg),
            hdop=self._first("hdop"),
            satellites=self._satellites(),
            correction_age_s=self._first("correction_age_s"),
        )

    def _ranked(self) -> list[EpochPart]:
        return sorted((p for p in self.parts.values() if p.rank), key=lambda p: -p.rank)

    def _best(self) -> EpochPart | None:
        return next((p for p in self._ranked() if p.lat_deg is not None), None)

    def _quality(self) -> FixQuality:
        told = next((p.quality for p in self._ranked() if p.quality is not None), None)
        if any(p.usable is False for p in self.parts.values()) or self._best() is None:
            return FixQuality.NONE
        return FixQuality.SINGLE if told is None else told

    def _first(self, field: str) -> float | None:
        by_rank = sorted(self.parts.values(), key=lambda p: -p.rank)
        return next((v for p in by_rank if (v := getattr(p, field)) is not None), None)

    def _satellites(self) -> int | None:
        return next((p.satellites for p in self._ranked() if p.satellites is not None), None)

    def _heading(self, mount: BaselineMount) -> tuple[float | None, float | None]:
        told = [p for p in self.parts.values() if p.heading_deg is not None]
        with_std = [p for p in told if p.heading_std_deg is not None]
        chosen = next(iter(with_std or told), None)
        if chosen is None or chosen.heading_deg is None:
            return None, None
        std_deg = chosen.heading_std_deg
        yaw = wrap(yaw_of_bearing(chosen.heading_deg) - mount.yaw_rad)
        return yaw, None if std_deg is None else math.radians(std_deg)


def _same_place(part: EpochPart, best: EpochPart) -> bool:
    if part.lat_deg is None or part.lon_deg is None or best.lat_deg is None or best.lon_deg is None:
        return True
    turn = abs(part.lon_deg - best.lon_deg)
    return abs(part.lat_deg - best.lat_deg) < SAME_PLACE_DEG and min(turn, 360.0 - turn) < SAME_PLACE_DEG


def yaw_of_bearing(bearing_deg: float) -> float:
    """Degrees clockwise from north -> rad counter-clockwise from east (REP 103)."""
    return wrap(math.radians(90.0 - bearing_deg))


def bearing_of_yaw(yaw_rad: float) -> float:
    """Inverse of `yaw_of_bearing`, in [0, 360)."""
    return (90.0 - math.degrees(yaw_rad)) % 360.0
