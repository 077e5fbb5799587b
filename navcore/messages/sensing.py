"""What the receiver and the inertial sensor measured."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum


class FixQuality(IntEnum):
    """GGA quality field."""

    NONE = 0
    SINGLE = 1
    DIFFERENTIAL = 2
    PPS = 3
    RTK_FIXED = 4
    RTK_FLOAT = 5
    DEAD_RECKONING = 6


@dataclass(frozen=True, slots=True, kw_only=True)
class GnssFix:
    """One epoch of a receiver.

    Attributes:
        utc_s: receiver's UTC as seconds since 1970, None before it knows date and time.
        lat_deg, lon_deg, height_m: antenna position, ellipsoidal height; None without a position.
        std_east_m, std_north_m, std_up_m: receiver's own 1-sigma, None if not told.
        heading_rad: yaw of `base_link` in ENU from a dual antenna, None without one.
        heading_std_rad: its 1-sigma, None if not told.
        hdop, satellites, correction_age_s: None if not told.
    """

    stamp_ns: int
    utc_s: float | None
    quality: FixQuality
    lat_deg: float | None
    lon_deg: float | None
    height_m: float | None
    std_east_m: float | None = None
    std_north_m: float | None = None
    std_up_m: float | None = None
    heading_rad: float | None = None
    heading_std_rad: float | None = None
    speed: float | None = None
    course_rad: float | None = None
    hdop: float | None = None
    satellites: int | None = None
    correction_age_s: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class ImuSample:
    """Turn rates (rad/s) and specific force (m/s^2) in `base_link`."""

    stamp_ns: int
    wx: float
    wy: float
    wz: float
    ax: float
    ay: float
    az: float
