"""Unicore and NovAtel `#` text -> parts of an epoch.

Sources: Unicore reference manual R1.4 (BESTNAVA, PVTSLNA, UNIHEADINGA, AGRICA); NovAtel OEM7 manual (BESTPOSA,
HEADINGA, tables "Position or Velocity Type" and "Solution Status"). Headers carry GPS week and time of week.
"""

from __future__ import annotations

from collections.abc import Callable
from datetime import date, timedelta

from navcore.drivers.epoch_part import EpochPart
from navcore.drivers.fields import NS_PER_S, Fields, checked_position
from navcore.drivers.nmea_sentences import ellipsoidal, gga_quality
from navcore.drivers.sentence import Refused, Sentence
from navcore.errors import SentenceError
from navcore.messages import FixQuality

GPS_START = date(1980, 1, 6)
LEAP_SECONDS = (
    (date(2017, 1, 1), 18), (date(2015, 7, 1), 17), (date(2012, 7, 1), 16), (date(2009, 1, 1), 15),
    (date(2006, 1, 1), 14), (date(1999, 1, 1), 13),
)  # fmt: skip
"""From when on GPS time was how much ahead of UTC (IERS Bulletin C)."""
EARLIEST_LEAP_S = 12
BDS_FIRST_WEEK, BDS_BEHIND_S = 1356, 14
"""BeiDou time began at this GPS week, and runs so much behind GPS time (BDS-SIS-ICD)."""
WEEK_NS = 7 * 86_400 * NS_PER_S
DAY_NS = 86_400 * NS_PER_S
SOLVED = "SOL_COMPUTED"
UNICORE_HEADER_FIELDS = 9
POSITION_TYPES = {
    "NONE": FixQuality.NONE,
    "SINGLE": FixQuality.SINGLE,
    "PSRDIFF": FixQuality.DIFFERENTIAL,
    "SBAS": FixQuality.DIFFERENTIAL,
    "WAAS": FixQuality.DIFFERENTIAL,
    "PPP_CONVERGING": FixQuality.DIFFERENTIAL,
    "PPP": FixQuality.DIFFERENTIAL,
    "PPP_BASIC_CONVERGING": FixQuality.DIFFERENTIAL,
    "PPP_BASIC": FixQuality.DIFFERENTIAL,
    "OMNISTAR": FixQuality.DIFFERENTIAL,
    "OMNISTAR_HP": FixQuality.DIFFERENTIAL,
    "OMNISTAR_XP": FixQuality.DIFFERENTIAL,
    "L1_FLOAT": FixQuality.RTK_FLOAT,
    "IONOFREE_FLOAT": FixQuality.RTK_FLOAT,
    "NARROW_FLOAT": FixQuality.RTK_FLOAT,
    "L1_INT": FixQuality.RTK_FIXED,
    "WIDE_INT": FixQuality.RTK_FIXED,
    "NARROW_INT": FixQuality.RTK_FIXED,
    "PROPAGATED": FixQuality.DEAD_RECKONING,
    "INS": FixQuality.DEAD_RECKONING,
}
When = tuple[date, int]


def read_unicore(sentence: Sentence, earliest_year: int) -> EpochPart | None:
    """Part of an epoch, or None for a log we do not use.

    Raises:
        SentenceError: if a field is not what the log demands.
    """
    reader = UNICORE_READERS.get(sentence.kind)
    if reader is None:
        return None
    f = Fields(sentence.fields, earliest_year)
    return reader(sentence.kind, f, _utc(sentence.header, f))


def _utc(header: tuple[str, ...], f: Fields) -> When:
    """Unicore: cpu, reference, status, week, ms, ...; NovAtel: port, sequence, idle, status, week, s, ..."""
    fields = Fields(header)
    if len(header) == UNICORE_HEADER_FIELDS and header[1] in ("GPS", "BDS"):
        week, week_ns = fields.integer(3), (fields.integer(4) or 0) * 1_000_000
    else:
        week, week_ns = fields.integer(4), _nanoseconds(header[5] if len(header) > 5 else "")
    if week is None or not 0 < week < 9999 or not 0 <= week_ns < WEEK_NS:
        raise SentenceError(Refused.TIME)
    if header[1] == "BDS" and week < BDS_FIRST_WEEK:  # no week of GPS: there was no BeiDou then
        week, week_ns = week + BDS_FIRST_WEEK, week_ns + BDS_BEHIND_S * NS_PER_S
    days, clock_ns = divmod(week_ns - leap_s(week, week_ns) * NS_PER_S, DAY_NS)
    day = GPS_START + timedelta(weeks=week, days=days)
    return f.calendar_day(day.year, day.month, day.day), clock_ns


def leap_s(week: int, week_ns: int) -> int:
    """By how much GPS time was ahead of UTC then."""
    seconds = week_ns // NS_PER_S
    for since, ahead in LEAP_SECONDS:
        if GPS_START + timedelta(weeks=week, seconds=seconds - ahead) >= since:
            return ahead
    return EARLIEST_LEAP_S


def _nanoseconds(seconds: str) -> int:
    whole, _, fraction = seconds.partition(".")
    if not (whole + fraction).isdigit() or not whole or len(seconds) > 20:
        raise SentenceError(Refused.TIME)
    return int(whole) * NS_PER_S + int(fraction[:9].ljust(9, "0"))


def bestpos(kind: str, f: Fields, when: When) -> EpochPart:
    """BESTPOSA, and BESTNAVA, which goes on with the velocity."""
    quality = _position_type(f.text(1)) if f.text(0) == SOLVED else FixQuality.NONE
    lat, lon = _position(f, 2, 3, quality)
    moving = kind == "BESTNAVA" and f.text(21) == SOLVED
    return EpochPart(
        kind=kind,
        rank=7,
        day=when[0],
        clock_ns=when[1],
        quality=quality,
        lat_deg=lat,
        lon_deg=lon,
        height_m=ellipsoidal(f.number(4), f.number(5)),
        std_north_m=f.positive(7),
        std_east_m=f.positive(8),
        std_up_m=f.positive(9),
        correction_age_s=f.number(11),
        satellites=f.integer(14),
        speed=f.number(25) if moving else None,
        course_deg=f.bearing_deg(26) if moving else None,
    )


def pvtsln(kind: str, f: Fields, when: When) -> EpochPart:
    """Position, velocity and heading in one log; the heading only while its ambiguities are fixed."""
    quality = _position_type(f.text(0))
    lat, lon = _position(f, 2, 3, quality)
    fixed = f.text(20) in POSITION_TYPES and _position_type(f.text(20)) is FixQuality.RTK_FIXED
    return EpochPart(
        kind=kind,
        rank=7,
        day=when[0],
        clock_ns=when[1],
        quality=quality,
        lat_deg=lat,
        lon_deg=lon,
        height_m=ellipsoidal(f.number(1), f.number(12)),
        std_up_m=f.positive(4),
        std_north_m=f.positive(5),
        std_east_m=f.positive(6),
        correction_age_s=f.number(7),
        satellites=f.integer(14),
        speed=f.number(19),
        heading_deg=f.bearing_deg(22) if fixed else None,
    )


def heading(kind: str, f: Fields, when: When) -> EpochPart:
    """HEADINGA and UNIHEADINGA: heading of the baseline from master to slave antenna, with its 1-sigma.

    A float solution counts only with its 1-sigma.
    """
    quality, std_deg = _position_type(f.text(1)), f.positive(6)
    honest_float = quality is FixQuality.RTK_FLOAT and std_deg is not None
    solved = f.text(0) == SOLVED and (quality is FixQuality.RTK_FIXED or honest_float)
    return EpochPart(
        kind=kind,
        day=when[0],
        clock_ns=when[1],
        heading_deg=f.bearing_deg(3) if solved else None,
        heading_std_deg=std_deg if solved else None,
    )


def agric(kind: str, f: Fields, when: When) -> EpochPart:
    """AGRICA: status coded as in GGA; heading status 4 is fixed."""
    quality = gga_quality(f, 8)
    lat, lon = _position(f, 29, 30, quality)
    return EpochPart(
        kind=kind,
        rank=6,
        day=when[0],
        clock_ns=when[1],
        quality=quality,
        lat_deg=lat,
        lon_deg=lon,
        height_m=ellipsoidal(f.number(31), f.number(50)),
        std_north_m=f.positive(35),
        std_east_m=f.positive(36),
        std_up_m=f.positive(37),
        heading_deg=f.bearing_deg(19) if f.integer(9) == FixQuality.RTK_FIXED else None,
        speed=f.number(22),
        course_deg=f.bearing_deg(49),
    )


def _position_type(text: str) -> FixQuality:
    if text in ("FIXEDPOS", "FIXEDHEIGHT"):
        raise SentenceError(Refused.NOT_MEASURED)
    if text.startswith("INS_"):
        return FixQuality.DEAD_RECKONING
    if text not in POSITION_TYPES:
        raise SentenceError(Refused.MALFORMED)
    return POSITION_TYPES[text]


def _position(f: Fields, lat: int, lon: int, quality: FixQuality) -> tuple[float | None, float | None]:
    if quality is FixQuality.NONE:
        return None, None
    return checked_position(f.needed(lat), f.needed(lon))


UNICORE_READERS: dict[str, Callable[[str, Fields, When], EpochPart]] = {
    "BESTPOSA": bestpos, "BESTNAVA": bestpos, "PVTSLNA": pvtsln, "HEADINGA": heading, "UNIHEADINGA": heading,
    "AGRICA": agric,
}  # fmt: skip
