"""Where the robot was some moments ago, by odometry: a scan and a picture are never of the same moment."""

from __future__ import annotations

from collections import deque
from itertools import pairwise

from navcore.geometry.se2 import SE2

KEPT = 100
# Requests further apart do not belong together, and no pose is told further beyond the newest one.
GAP_NS = 500_000_000
BEYOND_NS = 300_000_000


class OdometryTrail:
    """The last poses of `base_link` in `odom`, oldest first."""

    def __init__(self) -> None:
        self._poses: deque[tuple[int, SE2]] = deque(maxlen=KEPT)

    def add(self, stamp_ns: int, pose: SE2) -> None:
        """A pose later than all before it; an older one is passed over, and a gap begins the trail anew."""
        if self._poses and stamp_ns <= self._poses[-1][0]:
            return
        if self._poses and stamp_ns - self._poses[-1][0] > GAP_NS:
            self._poses.clear()
        self._poses.append((stamp_ns, pose))

    def at(self, stamp_ns: int) -> SE2 | None:
        """The pose at that moment, between the known ones or shortly beyond the newest; None where nobody knows."""
        if len(self._poses) < 2 or stamp_ns > self._poses[-1][0] + BEYOND_NS or stamp_ns < self._poses[0][0]:
            return None
        (t0, a), (t1, b) = next(
            ((earlier, later) for later, earlier in pairwise(reversed(self._poses)) if stamp_ns > earlier[0]),
            (self._poses[0], self._poses[1]),
        )
        return _between(a, b, (stamp_ns - t0) / (t1 - t0))


def _between(a: SE2, b: SE2, share: float) -> SE2:
    """The pose that far on the way from `a` to `b`, beyond `b` for more than 1, at an even speed and turn rate."""
    step = a.inverse() @ b
    return a @ SE2(share * step.x, share * step.y, share * step.yaw)
