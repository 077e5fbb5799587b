"""Standard NMEA 0183 sentences -> parts of an epoch. Field numbers after NMEA 0183 v4.11."""

from __future__ import annotations

from collections.abc import Callable

from navcore.drivers.epoch_part import EpochPart
from navcore.drivers.fields import Fields
from navcore.drivers.sentence import Refused
from navcore.errors import SentenceError
from navcore.messages import FixQuality

KNOT = 1852.0 / 3600.0
KM_H = 1.0 / 3.6
MODE_QUALITY = {
    "N": FixQuality.NONE,
    "A": FixQuality.SINGLE,
    "D": FixQuality.DIFFERENTIAL,
    "P": FixQuality.PPS,
    "R": FixQuality.RTK_FIXED,
    "F": FixQuality.RTK_FLOAT,
    "E": FixQuality.DEAD_RECKONING,
}
INVENTED_QUALITIES, INVENTED_MODES = (7, 8), frozenset("MS")
"""Manual input and simulator: no satellite's word."""
BEST_FIRST = "RFPDAE"


def gga_quality(f: Fields, i: int) -> FixQuality:
    """GGA field 6."""
    value = f.integer(i)
    if value is None:
        return FixQuality.NONE
    if value in INVENTED_QUALITIES:
        raise SentenceError(Refused.NOT_MEASURED)
    if value not in FixQuality.__members__.values():
        raise SentenceError(Refused.MALFORMED)
    return FixQuality(value)


def mode_quality(modes: str) -> FixQuality | None:
    """Mode indicator of RMC, GLL, VTG; GNS has one letter for each constellation, of which the best counts."""
    if not modes:
        return None
    if set(modes) & INVENTED_MODES:
        raise SentenceError(Refused.NOT_MEASURED)
    if set(modes) - set(MODE_QUALITY):
        raise SentenceError(Refused.MALFORMED)
    best = next((m for m in BEST_FIRST if m in modes), "N")
    return MODE_QUALITY[best]


def gga(f: Fields) -> EpochPart:
    """Fix data: quality, height above sea and geoid separation."""
    lat, lon = f.position_deg(1) or (None, None)
    return EpochPart(
        kind="GGA",
        rank=5,
        clock_ns=f.clock_ns(0),
        quality=gga_quality(f, 5),
        lat_deg=lat,
        lon_deg=lon,
        height_m=ellipsoidal(f.number(8), f.number(10)),
        satellites=f.integer(6),
        hdop=f.positive(7),
        correction_age_s=f.number(12),
    )


def ellipsoidal(sea_level_m: float | None, separation_m: float | None) -> float | None:
    """Height above the ellipsoid, None unless both parts are told."""
    return None if sea_level_m is None or separation_m is None else sea_level_m + separation_m


def gns(f: Fields) -> EpochPart:
    """Fix data of several constellations."""
    lat, lon = f.position_deg(1) or (None, None)
    return EpochPart(
        kind="GNS",
        rank=4,
        clock_ns=f.clock_ns(0),
        quality=mode_quality(f.text(5)),
        lat_deg=lat,
        lon_deg=lon,
        height_m=ellipsoidal(f.number(8), f.number(9)),
        satellites=f.integer(6),
        hdop=f.positive(7),
        correction_age_s=f.number(10),
    )


def rmc(f: Fields) -> EpochPart:
    """Recommended minimum: status, position, speed, course, date."""
    lat, lon = f.position_deg(2) or (None, None)
    knots = f.number(6)
    return EpochPart(
        kind="RMC",
        rank=3,
        clock_ns=f.clock_ns(0),
        day=f.day(8),
        usable=status(f.text(1)),
        quality=mode_quality(f.text(11)),
        lat_deg=lat,
        lon_deg=lon,
        speed=None if knots is None else knots * KNOT,
        course_deg=f.bearing_deg(7),
    )


def status(text: str) -> bool | None:
    """A (valid) or V (warning)."""
    if text not in ("A", "V", ""):
        raise SentenceError(Refused.MALFORMED)
    return None if not text else text == "A"


def gll(f: Fields) -> EpochPart:
    """Position alone."""
    lat, lon = f.position_deg(0) or (None, None)
    return EpochPart(
        kind="GLL",
        rank=2,
        clock_ns=f.clock_ns(4),
        usable=status(f.text(5)),
        quality=mode_quality(f.text(6)),
        lat_deg=lat,
        lon_deg=lon,
    )


def gst(f: Fields) -> EpochPart:
    """1-sigma of latitude, longitude, height in metres; 0 means that the receiver does not know."""
    return EpochPart(
        kind="GST",
        clock_ns=f.clock_ns(0),
        std_north_m=f.positive(5),
        std_east_m=f.positive(6),
        std_up_m=f.positive(7),
    )


def hdt(f: Fields) -> EpochPart:
    """True heading; empty until the receiver has one."""
    return EpochPart(kind="HDT", heading_deg=f.bearing_deg(0))


def ths(f: Fields) -> EpochPart:
    """True heading and its mode: only A (autonomous) is measured."""
    measured = f.text(1) == "A"
    return EpochPart(kind="THS", heading_deg=f.bearing_deg(0) if measured else None)


def zda(f: Fields) -> EpochPart:
    """Time and date."""
    numbers = [f.integer(i) for i in (1, 2, 3)]
    day, month, year = numbers
    told = day is not None and month is not None and year is not None
    return EpochPart(
        kind="ZDA",
        clock_ns=f.clock_ns(0),
        day=f.calendar_day(year or 0, month or 0, day or 0) if told else None,
    )


def vtg(f: Fields) -> EpochPart:
    """Course and speed over ground."""
    knots = f.number(4)
    return EpochPart(
        kind="VTG",
        course_deg=f.bearing_deg(0),
        speed=None if knots is None else knots * KNOT,
    )


def gsa(f: Fields) -> EpochPart:
    """Dilution of precision; what satellites are used is not ours to weigh."""
    return EpochPart(kind="GSA", hdop=f.positive(15))


NMEA_READERS: dict[str, Callable[[Fields], EpochPart]] = {
    "GGA": gga, "GNS": gns, "RMC": rmc, "GLL": gll, "GST": gst, "HDT": hdt, "THS": ths, "ZDA": zda, "VTG": vtg,
    "GSA": gsa,
}  # fmt: skip
