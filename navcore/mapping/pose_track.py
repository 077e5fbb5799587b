"""Where the robot was at any moment of a run."""

from __future__ import annotations

from bisect import bisect_left

import numpy as np

from navcore.geometry.se2 import SE2
from navcore.messages import PoseEstimate

Std = tuple[float, float]
# Between two poses further apart than this nobody knows where the robot was, ns.
LONGEST_GAP_NS = 300_000_000


class PoseTrack:
    """Poses of `base_link` in `map`, in any order; those without finite numbers are left out."""

    def __init__(self, poses: list[PoseEstimate]) -> None:
        finite = [p for p in poses if np.isfinite((p.x, p.y, p.yaw, *p.covariance)).all()]
        self._poses = sorted(finite, key=lambda pose: pose.stamp_ns)
        self._stamps = [pose.stamp_ns for pose in self._poses]

    def at(self, stamp_ns: int) -> tuple[SE2, Std] | None:
        """Pose at that moment and its 1-sigma along x and y, m; None where the track has a gap."""
        k = bisect_left(self._stamps, stamp_ns)
        if k < len(self._stamps) and self._stamps[k] == stamp_ns:
            exact = self._poses[k]
            return SE2(exact.x, exact.y, exact.yaw), _std(exact)
        if k in (0, len(self._poses)):
            return None
        before, after = self._poses[k - 1], self._poses[k]
        gap = after.stamp_ns - before.stamp_ns
        if gap > LONGEST_GAP_NS:
            return None
        share = (stamp_ns - before.stamp_ns) / gap
        step = SE2(before.x, before.y, before.yaw).inverse() @ SE2(after.x, after.y, after.yaw)
        part = SE2(share * step.x, share * step.y, share * step.yaw)
        return SE2(before.x, before.y, before.yaw) @ part, _std(before if share < 0.5 else after)


def _std(pose: PoseEstimate) -> Std:
    return max(pose.covariance[0], 0.0) ** 0.5, max(pose.covariance[4], 0.0) ** 0.5
