"""UTC of an epoch from a time of day and a date that comes only now and then."""

from __future__ import annotations

from datetime import date

from navcore.drivers.fields import NS_PER_S

DAY_NS = 86_400 * NS_PER_S
UNIX_START = date(1970, 1, 1).toordinal()


class ReceiverCalendar:
    """Turns times of day into a running time that knows no midnight, and into UTC once a date was told."""

    def __init__(self) -> None:
        self._days = 0
        self._clock_ns: int | None = None
        self._start_ns: int | None = None

    def running_ns(self, clock_ns: int) -> int:
        """Time since the midnight before the first call, for a time of day within 12 h of the last one."""
        turn = 0 if self._clock_ns is None else clock_ns - self._clock_ns
        if turn < -DAY_NS // 2:
            self._days += 1
        elif turn > DAY_NS // 2:
            self._days -= 1
        self._clock_ns = clock_ns
        return self._days * DAY_NS + clock_ns

    def learn(self, day: date, clock_ns: int) -> None:
        """A sentence told date and time of day together."""
        self.running_ns(clock_ns)
        self._start_ns = (day.toordinal() - UNIX_START - self._days) * DAY_NS

    def utc_ns(self, running_ns: int) -> int | None:
        """Nanoseconds since 1970 of a running time, None before any date is known."""
        return None if self._start_ns is None else self._start_ns + running_ns
