"""The clock of the control loop: ticks at absolute times, so that lateness never adds up."""

from __future__ import annotations

import time


class Ticker:
    """Periodic instants of the monotonic clock; those that were missed are skipped."""

    def __init__(self, period_ns: int) -> None:
        self._period_ns = period_ns
        self.next_ns = time.monotonic_ns() + period_ns

    def wait(self) -> int:
        """Sleep until the next instant. The lateness of waking, ns."""
        wait_ns = self.next_ns - time.monotonic_ns()
        if wait_ns > 0:
            time.sleep(wait_ns * 1e-9)
        late_ns = time.monotonic_ns() - self.next_ns
        self.next_ns += self._period_ns * (1 + max(0, late_ns) // self._period_ns)
        return late_ns


class Every:
    """Says once per period that something is due."""

    def __init__(self, period_ns: int) -> None:
        self._period_ns = period_ns
        self._next_ns = 0

    def due(self, now_ns: int) -> bool:
        """True if the period has passed; what was missed is not made up for."""
        if now_ns < self._next_ns:
            return False
        self._next_ns = max(self._next_ns + self._period_ns, now_ns + self._period_ns // 2)
        return True
