"""Receiver time -> monotonic time of capture.

A packet can be late but never early. So the smallest observed (arrival - receiver time) is the best estimate of the
offset between the two clocks plus the shortest transport; what lies above it is jitter of the transport, not of the
capture. (The minimum filter of clock offset estimation, as in NTP, RFC 5905 section 10.)
"""

from __future__ import annotations

from dataclasses import dataclass

from navcore.errors import ConfigError


@dataclass(frozen=True, slots=True, kw_only=True)
class CaptureClockParams:
    """Parameters of `CaptureClock`.

    Attributes:
        shortest_delay_s: from the antenna's epoch to the first byte at our door at the very best; 0 to 1 s. 0.1 s is
            an assumption for RTK receivers at 5 to 10 Hz; measure it with the receiver's pulse per second.
        drift_ppm: by how much the monotonic clock may run apart from GNSS time; the minimum leaks upwards at this
            rate; 1 to 1000. Quartz is within 50.
        latest_s: a packet later than this is no evidence and, repeated, a jump of the receiver's time; 0.1 to 10 s.
        agree_s: epochs after a jump have to agree this well before the new time is believed; 0.001 to 1 s.
        agree_epochs: how many of them; 2 to 100.
    """

    shortest_delay_s: float = 0.1
    drift_ppm: int = 100
    latest_s: float = 1.0
    agree_s: float = 0.1
    agree_epochs: int = 5

    def __post_init__(self) -> None:
        ok = 0 <= self.shortest_delay_s <= 1 and 1 <= self.drift_ppm <= 1000 and 0.1 <= self.latest_s <= 10
        if not (ok and 0.001 <= self.agree_s <= 1 and 2 <= self.agree_epochs <= 100):
            raise ConfigError("A value of CaptureClockParams is out of its bounds; its docstring names them.")


class CaptureClock:
    """Maps one receiver's epochs; `capture_ns` is called once for each epoch, in the order of arrival."""

    def __init__(self, params: CaptureClockParams | None = None) -> None:
        p = params or CaptureClockParams()
        self._shortest_delay_ns = round(p.shortest_delay_s * 1e9)
        self._latest_ns = round(p.latest_s * 1e9)
        self._agree_ns = round(p.agree_s * 1e9)
        self._params = p
        self._offset_ns: int | None = None
        self._receiver_ns = 0
        self._strange: list[int] = []

    def capture_ns(self, receiver_ns: int, arrival_ns: int) -> int | None:
        """Monotonic capture time, never after the arrival; None while the receiver's time is not believed."""
        observed = arrival_ns - receiver_ns
        if self._offset_ns is None:
            self._anchor(observed, receiver_ns)
        offset = self._leaked(receiver_ns)
        if abs(observed - offset) > self._latest_ns:
            return self._doubt(observed, receiver_ns, arrival_ns)
        self._strange.clear()
        self._anchor(min(observed, offset), receiver_ns)
        return self._stamp(receiver_ns, arrival_ns)

    def unknown_ns(self, arrival_ns: int) -> int:
        """Capture time of an epoch whose receiver does not know the time."""
        return arrival_ns - self._shortest_delay_ns

    def _leaked(self, receiver_ns: int) -> int:
        assert self._offset_ns is not None
        elapsed = max(0, receiver_ns - self._receiver_ns)
        return self._offset_ns + elapsed * self._params.drift_ppm // 1_000_000

    def _anchor(self, offset_ns: int, receiver_ns: int) -> None:
        self._offset_ns, self._receiver_ns = offset_ns, receiver_ns

    def _stamp(self, receiver_ns: int, arrival_ns: int) -> int:
        assert self._offset_ns is not None
        return min(arrival_ns, receiver_ns + self._offset_ns - self._shortest_delay_ns)

    def _doubt(self, observed: int, receiver_ns: int, arrival_ns: int) -> int | None:
        """Believe a new time only after enough epochs in a row agree on it."""
        if self._strange and abs(observed - self._strange[-1]) > self._agree_ns:
            self._strange.clear()
        self._strange.append(observed)
        if len(self._strange) < self._params.agree_epochs:
            return None
        self._anchor(min(self._strange), receiver_ns)
        self._strange.clear()
        return self._stamp(receiver_ns, arrival_ns)
