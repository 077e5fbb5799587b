"""A LiDAR's microseconds, which start anew every second or hour, to the monotonic clock."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum, auto

from navcore.drivers.capture_clock import CaptureClock, CaptureClockParams
from navcore.errors import ConfigError


class Step(Enum):
    """How a packet follows the one before."""

    ON = auto()
    REPEATED = auto()
    LATE = auto()
    JUMPED = auto()


@dataclass(frozen=True, slots=True, kw_only=True)
class PacketClockParams:
    """Parameters of `PacketClock`.

    Attributes:
        late_s: a packet older than the one before by no more than this was overtaken on its way, else the clock went
            back; 0.001 to 0.1 s.
        jump_s: the device's clock and ours may differ so much from one packet to the next (a reader that was held up)
            before it is a jump; 0.05 to 0.45 s, as the C16 tells no more than the second.
        shortest_delay_s: from a packet's last ray to our door, at the very best; 0 to 0.1 s. Half a millisecond is an
            assumption for a cable between the two.
    """

    late_s: float = 0.02
    jump_s: float = 0.4
    shortest_delay_s: float = 0.0005

    def __post_init__(self) -> None:
        ok = 0.001 <= self.late_s <= 0.1 and 0.05 <= self.jump_s <= 0.45 and 0 <= self.shortest_delay_s <= 0.1
        if not ok:
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
        self._start()

    def _start(self) -> None:
        delay = CaptureClockParams(shortest_delay_s=self._p.shortest_delay_s)
        self._capture = CaptureClock(delay)
        self._stamp_ns = self._stamp_us = 0

    def follow(self, counter_us: int, arrived_ns: int) -> Step:
        """Take in a packet's time, unless it is no newer than the one before."""
        if self._arrived_ns is None:
            return self._begin(counter_us, arrived_ns)
        waited_us = (arrived_ns - self._arrived_ns) / 1000.0
        step_us = self._nearest(counter_us - self.us, waited_us)
        if -self._p.late_s * 1e6 <= step_us <= 0:
            return Step.LATE if step_us else Step.REPEATED
        if step_us < 0 or abs(step_us - waited_us) > self._p.jump_s * 1e6:
            self._start()
            self._begin(counter_us, arrived_ns)
            return Step.JUMPED
        self._take(self.us + step_us, arrived_ns)
        return Step.ON

    def stamp_ns(self, us: float) -> int:
        """When on the monotonic clock the device's was at `us`."""
        return self._stamp_ns + round((us - self._stamp_us) * 1000.0)

    def _nearest(self, step_us: int, waited_us: float) -> int:
        """The counter's step with as many new starts as fit the time that passed here."""
        return step_us + round((waited_us - step_us) / self._period) * self._period

    def _begin(self, counter_us: int, arrived_ns: int) -> Step:
        self._take(counter_us, arrived_ns)
        return Step.ON

    def _take(self, us: int, arrived_ns: int) -> None:
        self.us, self._arrived_ns = us, arrived_ns
        stamp = self._capture.capture_ns(us * 1000, arrived_ns)
        if stamp is None:
            self._start()
            stamp = self._capture.capture_ns(us * 1000, arrived_ns)
        assert stamp is not None
        self._stamp_ns, self._stamp_us = stamp, us
