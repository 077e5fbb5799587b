"""Fields of a sentence, read strictly: an empty field is None, anything else is what it must be or refused."""

from __future__ import annotations

import re
from datetime import date

from navcore.drivers.sentence import Refused
from navcore.errors import SentenceError

NUMBER = re.compile(r"[+-]?(\d{1,12}(\.\d{0,12})?|\.\d{1,12})")
CLOCK = re.compile(r"(\d\d)(\d\d)(\d\d)(?:\.(\d{0,9}))?")
COORDINATE = re.compile(r"-?(\d{2,3})(\d\d(?:\.\d{0,12})?)")
NS_PER_S = 1_000_000_000


class Fields:
    """Reader over the fields; every method takes the index of a field. A field that is missing reads as empty.

    Raises:
        SentenceError: from every method, when the field is not what it must be.
    """

    def __init__(self, fields: tuple[str, ...], earliest_year: int = 0) -> None:
        self._fields = fields
        self._earliest_year = earliest_year

    def text(self, i: int) -> str:
        """The field as it stands."""
        return self._fields[i] if i < len(self._fields) else ""

    def number(self, i: int) -> float | None:
        """A plain decimal number; NaN, infinity and exponents are none."""
        text = self.text(i).strip()
        if not text:
            return None
        if NUMBER.fullmatch(text) is None:
            raise SentenceError(Refused.MALFORMED)
        return float(text)

    def needed(self, i: int) -> float:
        """A number that must be there."""
        value = self.number(i)
        if value is None:
            raise SentenceError(Refused.MALFORMED)
        return value

    def positive(self, i: int) -> float | None:
        """A number that is above zero, None where it is 0 (receivers write 0 for "not known")."""
        value = self.number(i)
        return value if value is not None and value > 0.0 else None

    def integer(self, i: int) -> int | None:
        """A whole number."""
        value = self.number(i)
        if value is None:
            return None
        if value != int(value):
            raise SentenceError(Refused.MALFORMED)
        return int(value)

    def bearing_deg(self, i: int) -> float | None:
        """Degrees clockwise from north in [0, 360]."""
        value = self.number(i)
        if value is not None and not 0.0 <= value <= 360.0:
            raise SentenceError(Refused.MALFORMED)
        return value

    def clock_ns(self, i: int) -> int | None:
        """`hhmmss.sss` as nanoseconds of the UTC day; second 60 is a leap second."""
        text = self.text(i)
        return None if not text else clock_ns(text)

    def day(self, i: int) -> date | None:
        """`ddmmyy`."""
        text = self.text(i)
        if not text:
            return None
        if len(text) != 6 or not text.isascii() or not text.isdigit():
            raise SentenceError(Refused.MALFORMED)
        return self.calendar_day(2000 + int(text[4:]), int(text[2:4]), int(text[:2]))

    def calendar_day(self, year: int, month: int, day: int) -> date:
        """A day that exists and is not older than any receiver of ours."""
        try:
            found = date(year, month, day)
        except (ValueError, OverflowError):
            raise SentenceError(Refused.TIME) from None
        if found.year < self._earliest_year:
            raise SentenceError(Refused.TIME)
        return found

    def position_deg(self, i: int) -> tuple[float, float] | None:
        """`ddmm.mmmm,N,dddmm.mmmm,E` from field i on -> (lat_deg, lon_deg), None where all are empty."""
        if not self.text(i) and not self.text(i + 2):
            return None
        lat = _coordinate(self.text(i), self.text(i + 1), "N", "S")
        lon = _coordinate(self.text(i + 2), self.text(i + 3), "E", "W")
        return checked_position(lat, lon)


def clock_ns(text: str) -> int:
    """`hhmmss.sss` as nanoseconds of the UTC day."""
    match = CLOCK.fullmatch(text)
    if match is None:
        raise SentenceError(Refused.TIME)
    h, m, s = (int(match.group(k)) for k in (1, 2, 3))
    if h > 23 or m > 59 or s > 60:
        raise SentenceError(Refused.TIME)
    fraction = (match.group(4) or "").ljust(9, "0")
    return ((h * 60 + m) * 60 + s) * NS_PER_S + int(fraction)


def checked_position(lat_deg: float, lon_deg: float) -> tuple[float, float]:
    """The position, if it can be one."""
    if not (-90.0 <= lat_deg <= 90.0 and -180.0 <= lon_deg <= 180.0):
        raise SentenceError(Refused.MALFORMED)
    if abs(lat_deg) < 1e-6 and abs(lon_deg) < 1e-6:
        raise SentenceError(Refused.ZERO_POSITION)
    return lat_deg, lon_deg


def _coordinate(text: str, side: str, plus: str, minus: str) -> float:
    match = COORDINATE.fullmatch(text)
    if match is None or side not in (plus, minus) or float(match.group(2)) >= 60.0:
        raise SentenceError(Refused.MALFORMED)
    value = int(match.group(1)) + float(match.group(2)) / 60.0
    return -value if side == minus else value
