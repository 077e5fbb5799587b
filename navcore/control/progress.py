"""Is the robot getting anywhere?"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class ProgressParams:
    """Attributes:
    distance, time_s: less than `distance` m of progress in `time_s` counts as stuck (Nav2's progress checker).
    """

    distance: float = 0.5
    time_s: float = 10.0


class ProgressCheck:
    """Tells when a robot that is asked to drive does not get on."""

    def __init__(self, params: ProgressParams = ProgressParams()) -> None:
        self._params = params
        self._since: tuple[int, float] | None = None

    def reset(self) -> None:
        """Start counting anew: called whenever the robot is meant to stand."""
        self._since = None

    def stuck(self, now_ns: int, progress: float) -> bool:
        """True if `progress` (m along the mission) has not grown by `distance` within `time_s` of being asked."""
        if self._since is None or progress >= self._since[1] + self._params.distance:
            self._since = (now_ns, progress)
        return (now_ns - self._since[0]) * 1e-9 > self._params.time_s
