"""How much of a training run is done, by steps or by the clock, and the learning rate's course over it."""

from __future__ import annotations

import math
import time

WARM_UP = 0.1


class Budget:
    """So many steps, but no longer than so many minutes of training (None: without end)."""

    def __init__(self, *, steps: int, minutes: float | None) -> None:
        self._steps, self._seconds = steps, None if minutes is None else 60.0 * minutes
        self._done, self._before = 0, 0.0
        self._started = time.monotonic()

    def resume(self, *, done: int, elapsed: float) -> None:
        """Go on after so many steps and seconds."""
        self._done, self._before, self._started = done, elapsed, time.monotonic()

    def state(self) -> dict[str, float]:
        """What `resume` needs."""
        return {"done": self._done, "elapsed": self._elapsed()}

    def step(self) -> None:
        """One more step is done."""
        self._done += 1

    def fraction(self) -> float:
        """Share of the run that is done, 0 to 1."""
        by_clock = 0.0 if self._seconds is None else self._elapsed() / self._seconds
        return min(1.0, max(self._done / self._steps, by_clock))

    def spent(self) -> bool:
        """Whether it is over."""
        return self.fraction() >= 1.0

    def course(self) -> float:
        """Factor on the highest learning rate: up in a line, down along a cosine (Smith 2018)."""
        fraction = self.fraction()
        if fraction < WARM_UP:
            return 0.04 + 0.96 * fraction / WARM_UP
        return 0.5 + 0.5 * math.cos(math.pi * (fraction - WARM_UP) / (1.0 - WARM_UP))

    def _elapsed(self) -> float:
        return self._before + time.monotonic() - self._started
