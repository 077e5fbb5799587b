"""Makers' own `$` sentences that carry a position or the heading of two antennas.

Sources: Unicore reference manual R1.4 (HPR, KSXT); SkyTraq AN0039 (PSTI 030, 036); Trimble BD9xx manual (PTNL AVR,
GGK); Ashtech / Hemisphere (PASHR).
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import date

from navcore.drivers.epoch_part import EpochPart
from navcore.drivers.fields import Fields, checked_position, clock_ns
from navcore.drivers.nmea_sentences import KM_H, mode_quality, status
from navcore.drivers.sentence import Refused
from navcore.errors import SentenceError
from navcore.messages import FixQuality

TRIMBLE_QUALITY = {
    0: FixQuality.NONE,
    1: FixQuality.SINGLE,
    2: FixQuality.RTK_FLOAT,
    3: FixQuality.RTK_FIXED,
    4: FixQuality.DIFFERENTIAL,
    5: FixQuality.DIFFERENTIAL,
    6: FixQuality.RTK_FLOAT,
    7: FixQuality.RTK_FIXED,
    8: FixQuality.RTK_FLOAT,
    9: FixQuality.RTK_FIXED,
    10: FixQuality.DIFFERENTIAL,
    11: FixQuality.DIFFERENTIAL,
}
"""6 to 9: in a network, with and without height; 10, 11: OmniSTAR."""
KSXT_QUALITY = {0: FixQuality.NONE, 1: FixQuality.SINGLE, 2: FixQuality.RTK_FLOAT, 3: FixQuality.RTK_FIXED}
KSXT_HEADING_FIXED = 3
HPR_FIXED = 4


def hpr(f: Fields) -> EpochPart:
    """Heading, pitch, roll of Unicore; used only while its ambiguities are fixed (quality 4)."""
    fixed = f.integer(4) == HPR_FIXED
    return EpochPart(kind="HPR", clock_ns=f.clock_ns(0), heading_deg=f.bearing_deg(1) if fixed else None)


def ksxt(f: Fields) -> EpochPart:
    """Position, heading and speed of Unicore.

    Its height is left out: manuals differ on whether it is above sea level or above the ellipsoid.
    """
    quality = _lookup(KSXT_QUALITY, f.integer(9))
    lat, lon = _plain_position(f, 2, 1) if quality is not FixQuality.NONE else (None, None)
    stamp = f.text(0)
    speed = f.number(7)
    return EpochPart(
        kind="KSXT",
        rank=6,
        clock_ns=clock_ns(stamp[8:]),
        day=_day_yyyymmdd(f, stamp[:8]),
        quality=quality,
        lat_deg=lat,
        lon_deg=lon,
        heading_deg=_circle(f.number(4)) if f.integer(10) == KSXT_HEADING_FIXED else None,
        course_deg=_circle(f.number(6)),
        speed=None if speed is None else speed * KM_H,
        satellites=f.integer(12),
    )


def psti_030(f: Fields) -> EpochPart:
    """Recommended minimum of SkyTraq with date, RTK mode and age of corrections.

    It ranks below GGA: its mode letter is unknown to NMEA while the rover's base moves (O).
    """
    east, north = f.number(7), f.number(8)
    return EpochPart(
        kind="PSTI,030",
        clock_ns=f.clock_ns(0),
        day=f.day(10),
        usable=status(f.text(1)),
        speed=None if east is None or north is None else float((east**2 + north**2) ** 0.5),
        correction_age_s=f.number(12),
    )


def psti_036(f: Fields) -> EpochPart:
    """Heading, pitch, roll of SkyTraq; R is the mode of fixed ambiguities."""
    fixed = mode_quality(f.text(5)) is FixQuality.RTK_FIXED
    return EpochPart(
        kind="PSTI,036",
        clock_ns=f.clock_ns(0),
        day=f.day(1),
        heading_deg=f.bearing_deg(2) if fixed else None,
    )


def pashr(f: Fields) -> EpochPart:
    """Attitude with accuracies, degrees; quality 0 means no position behind it."""
    real = f.text(2) == "T" and (f.integer(9) or 0) > 0
    return EpochPart(
        kind="PASHR",
        clock_ns=f.clock_ns(0),
        heading_deg=f.bearing_deg(1) if real else None,
        heading_std_deg=f.positive(8) if real else None,
    )


def ptnl_avr(f: Fields) -> EpochPart:
    """Yaw of Trimble's moving-base baseline; used only while fixed (3)."""
    fixed = _lookup(TRIMBLE_QUALITY, f.integer(8)) is FixQuality.RTK_FIXED and f.text(2) == "Yaw"
    return EpochPart(
        kind="PTNL,AVR",
        clock_ns=f.clock_ns(0),
        heading_deg=_circle(f.number(1)) if fixed else None,
    )


def ptnl_ggk(f: Fields) -> EpochPart:
    """Position of Trimble with month-first date and an ellipsoidal height written `EHT150.790`."""
    lat, lon = f.position_deg(2) or (None, None)
    height = Fields((f.text(9).removeprefix("EHT"),)).number(0) if f.text(9).startswith("EHT") else None
    month_first = f.text(1)
    return EpochPart(
        kind="PTNL,GGK",
        rank=4,
        clock_ns=f.clock_ns(0),
        day=Fields((month_first[2:4] + month_first[:2] + month_first[4:],)).day(0),
        quality=_lookup(TRIMBLE_QUALITY, f.integer(6)),
        lat_deg=lat,
        lon_deg=lon,
        height_m=height,
        satellites=f.integer(7),
    )


def _lookup(table: dict[int, FixQuality], value: int | None) -> FixQuality:
    if value is None or value not in table:
        raise SentenceError(Refused.MALFORMED)
    return table[value]


def _plain_position(f: Fields, lat: int, lon: int) -> tuple[float, float]:
    return checked_position(f.needed(lat), f.needed(lon))


def _circle(angle_deg: float | None) -> float | None:
    """Yaw of either sign -> degrees in [0, 360)."""
    if angle_deg is not None and not -360.0 <= angle_deg <= 360.0:
        raise SentenceError(Refused.MALFORMED)
    return None if angle_deg is None else angle_deg % 360.0


def _day_yyyymmdd(f: Fields, text: str) -> date:
    if len(text) != 8 or not text.isdigit():
        raise SentenceError(Refused.TIME)
    return f.calendar_day(int(text[:4]), int(text[4:6]), int(text[6:]))


VENDOR_READERS: dict[str, Callable[[Fields], EpochPart]] = {
    "HPR": hpr, "KSXT": ksxt, "PSTI,030": psti_030, "PSTI,036": psti_036, "PASHR": pashr, "PTNL,AVR": ptnl_avr,
    "PTNL,GGK": ptnl_ggk,
}  # fmt: skip
