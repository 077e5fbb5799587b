"""A LiDAR's microseconds, which start anew every second or hour, to the monotonic clock.

A packet can be late but never early: the smallest (arrival - device time) of the last seconds is the offset between
the two clocks. So many packets come that the last seconds suffice; a clock that is set anew is right again as fast.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto

from navcore.errors import ConfigError


class Step(Enum):
    """How a packet follows the one before."""

    ON = auto()
    REPEATED = auto()
    LATE = auto()
    JUMPED = auto()
    SILENCE = auto()


@dataclass(frozen=True, slots=True, kw_only=True)
class PacketClockParams:
    """Parameters of `PacketClock`.

    Attributes:
        late_s: a packet older than the one before by no more than this was overtaken on its way, else the clock went
            back; 0.001 to 0.1 s.
        silent_s: after so long without packets nothing is taken to go on as before; 0.05 to 0.5 s, as a C16 tells no
            more than the second.
        jump_s: the device's clock and ours may differ so much from one packet to the next (a reader that was held up)
            before it is a jump; 0.05 to 0.45 s.
        window_s: how far back arrivals count; 0.1 to 60 s. In 2 s two quartzes run apart by 0.2 ms.
        shortest_delay_s: from a packet's last ray to our door, at the very best; 0 to 0.1 s. Half a millisecond is an
            assumption for a cable between the two.
    """

    late_s: float = 0.02
    silent_s: float = 0.5
    jump_s: float = 0.4
    window_s: float = 2.0
    shortest_delay_s: float = 0.0005

    def __post_init__(self) -> None:
        ok = 0.001 <= self.late_s <= 0.1 and 0.05 <= self.silent_s <= 0.5 and 0.05 <= self.jump_s <= 0.45
        if not (ok and 0.1 <= self.window_s <= 60 and 0 <= self.shortest_delay_s <= 0.1):
            raise ConfigError("A value of PacketClockParams is out of its bounds; its docstring names them.")


class PacketClock:
    """One device's clock.

    Attributes:
        us: of the newest packet, counted on over every new start of the counter.
    """

    def __init__(self, counter_us: int, params: PacketClockParams = PacketClockParams()) -> None:
        self._period, self._p = counter_us, params
        self._arrived_ns: int | None = None
        self.us = 0
        self._offset = _LeastOffset(round(params.window_s * 1e9))

    def follow(self, counter_us: int, arrived_ns: int) -> Step:
        """Take in a packet's time, unless it is no newer than the one before."""
        if self._arrived_ns is None:
            return self._take(counter_us, arrived_ns, Step.ON)
        waited_us = (arrived_ns - self._arrived_ns) / 1000.0
        if waited_us > self._p.silent_s * 1e6:
            return self._start(counter_us, arrived_ns, Step.SILENCE)
        step_us = self._nearest(counter_us - self.us, waited_us)
        if -self._p.late_s * 1e6 <= step_us <= 0:
            return Step.LATE if step_us else Step.REPEATED
        if step_us < 0 or abs(step_us - waited_us) > self._p.jump_s * 1e6:
            return self._start(counter_us, arrived_ns, Step.JUMPED)
        return self._take(self.us + step_us, arrived_ns, Step.ON)

    def stamp_ns(self, us: float) -> int:
        """When on the monotonic clock the device's was at `us`."""
        return round(us * 1000.0) + self._offset.ns - round(self._p.shortest_delay_s * 1e9)

    def _nearest(self, step_us: int, waited_us: float) -> int:
        """The counter's step with as many new starts as fit the time that passed here."""
        return step_us + round((waited_us - step_us) / self._period) * self._period

    def _start(self, counter_us: int, arrived_ns: int, step: Step) -> Step:
        self._offset = _LeastOffset(round(self._p.window_s * 1e9))
        return self._take(counter_us, arrived_ns, step)

    def _take(self, us: int, arrived_ns: int, step: Step) -> Step:
        self.us, self._arrived_ns = us, arrived_ns
        self._offset.add(arrived_ns - us * 1000, arrived_ns)
        return step


class _LeastOffset:
    """Least of what came in the last one to two windows.

    Attributes:
        ns: that.
    """

    def __init__(self, window_ns: int) -> None:
        self._window_ns = window_ns
        self._since_ns: int | None = None
        self._before = self._now = self.ns = 0

    def add(self, offset_ns: int, arrived_ns: int) -> None:
        if self._since_ns is None:
            self._since_ns, self._before, self._now = arrived_ns, offset_ns, offset_ns
        elif arrived_ns - self._since_ns > self._window_ns:
            self._since_ns, self._before, self._now = arrived_ns, self._now, offset_ns
        self._now = min(self._now, offset_ns)
        self.ns = min(self._before, self._now)
