"""What a receiver sends: NMEA 0183 sentences (version 4.11, sections GGA, RMC, GST, HDT) with checksums."""

from __future__ import annotations

import math
from dataclasses import dataclass
from datetime import UTC, datetime

from navcore.messages import FixQuality

_RMC_MODE = {
    FixQuality.NONE: "N", FixQuality.SINGLE: "A", FixQuality.DIFFERENTIAL: "D", FixQuality.PPS: "P",
    FixQuality.RTK_FIXED: "R", FixQuality.RTK_FLOAT: "F", FixQuality.DEAD_RECKONING: "E",
}  # fmt: skip
_KNOTS_PER_M_S = 3600.0 / 1852.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ReceiverEpoch:
    """One solution of the receiver, in its own terms.

    Attributes:
        utc_s: seconds since 1970.
        height_m: ellipsoidal; `geoid_m` above it the ellipsoid lies below mean sea level's surface.
        std_m: 1-sigma east, north, up as the receiver believes.
        course_deg, heading_deg: clockwise from north; heading None while the second antenna has no solution.
        age_s: of the corrections, None without.
    """

    utc_s: float
    quality: FixQuality
    lat_deg: float
    lon_deg: float
    height_m: float
    geoid_m: float
    satellites: int
    hdop: float
    std_m: tuple[float, float, float]
    speed: float
    course_deg: float
    heading_deg: float | None
    age_s: float | None


def sentences(epoch: ReceiverEpoch) -> tuple[str, ...]:
    """GGA, RMC, GST and HDT of one epoch, each with checksum and line end."""
    when = datetime.fromtimestamp(round(epoch.utc_s, 2), UTC)
    clock = when.strftime("%H%M%S.") + f"{when.microsecond // 10000:02d}"
    fixed = epoch.quality is not FixQuality.NONE
    place = _place(epoch) if fixed else ",,,"
    return tuple(
        _framed(body)
        for body in (
            _gga(epoch, clock, place, fixed),
            _rmc(epoch, clock, place, fixed, when.strftime("%d%m%y")),
            _gst(epoch, clock, fixed),
            "GNHDT,,T" if epoch.heading_deg is None else f"GNHDT,{epoch.heading_deg % 360.0:.3f},T",
        )
    )


def _gga(epoch: ReceiverEpoch, clock: str, place: str, fixed: bool) -> str:
    height = f"{epoch.height_m - epoch.geoid_m:.3f},M,{epoch.geoid_m:.3f},M" if fixed else ",M,,M"
    age = "," if epoch.age_s is None else f"{epoch.age_s:.1f},0123"
    hdop = f"{min(epoch.hdop, 99.9):.2f}"
    return f"GNGGA,{clock},{place},{epoch.quality:d},{epoch.satellites:02d},{hdop},{height},{age}"


def _rmc(epoch: ReceiverEpoch, clock: str, place: str, fixed: bool, date: str) -> str:
    motion = f"{epoch.speed * _KNOTS_PER_M_S:.3f},{epoch.course_deg % 360.0:.2f}" if fixed else ","
    return f"GNRMC,{clock},{'A' if fixed else 'V'},{place},{motion},{date},,,{_RMC_MODE[epoch.quality]}"


def _gst(epoch: ReceiverEpoch, clock: str, fixed: bool) -> str:
    if not fixed:
        return f"GNGST,{clock},,,,,,,"
    east, north, up = epoch.std_m
    rms, major, minor = math.hypot(east, north), max(east, north), min(east, north)
    return f"GNGST,{clock},{rms:.3f},{major:.3f},{minor:.3f},0.0,{north:.3f},{east:.3f},{up:.3f}"


def _place(epoch: ReceiverEpoch) -> str:
    north, east = "N" if epoch.lat_deg >= 0 else "S", "E" if epoch.lon_deg >= 0 else "W"
    return f"{_degrees_minutes(epoch.lat_deg, 2)},{north},{_degrees_minutes(epoch.lon_deg, 3)},{east}"


def _degrees_minutes(angle_deg: float, digits: int) -> str:
    """ddmm.mmmmmmm; rounded first, so that 60 minutes are never written."""
    units = round(abs(angle_deg) * 60.0 * 1e7)
    degrees, minutes = divmod(units, 60 * 10**7)
    return f"{degrees:0{digits}d}{minutes // 10**7:02d}.{minutes % 10**7:07d}"


def _framed(body: str) -> str:
    checksum = 0
    for byte in body.encode("ascii"):
        checksum ^= byte
    return f"${body}*{checksum:02X}\r\n"
