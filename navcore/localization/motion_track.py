"""How the robot moved during a scan: its poses, or its speeds and turn rates, over that time."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from navcore.errors import InputError, NotFiniteError
from navcore.geometry.screw import Screw
from navcore.geometry.se3 import SE3

NS = 1e-9


@dataclass(frozen=True, slots=True, eq=False)
class MotionTrack:
    """Poses of `base_link` in a frame that stands still, with constant speed and turn rates in between.

    Attributes:
        stamps_ns: (M,) growing, M at least 2. poses: T_still_base at those times.
        screws: (M - 1,) from each to the next.
    """

    stamps_ns: tuple[int, ...]
    poses: tuple[SE3, ...]
    screws: tuple[Screw, ...]

    @staticmethod
    def of_poses(stamps_ns: Sequence[int], poses: Sequence[SE3]) -> MotionTrack:
        """Raises InputError for stamps that do not grow, or for fewer than two; NotFiniteError for NaN."""
        _refuse_stamps(stamps_ns, len(poses))
        if not all(np.all(np.isfinite(pose.R)) and np.all(np.isfinite(pose.t)) for pose in poses):
            raise NotFiniteError("A pose of the robot is not finite; leave it out.")
        screws = tuple(Screw.between(begin, end) for begin, end in pairwise(poses))
        return MotionTrack(tuple(stamps_ns), tuple(poses), screws)

    @staticmethod
    def of_rates(stamps_ns: Sequence[int], v: ArrayLike, omega: ArrayLike) -> MotionTrack:
        """Measured speeds along `base_link` x (M,), m/s, and turn rates (M, 3), rad/s: the mean of two neighbours
        holds between them. Raises as `of_poses`.
        """
        speeds, rates = np.asarray(v, dtype=np.float64), np.asarray(omega, dtype=np.float64)
        _refuse_stamps(stamps_ns, len(speeds))
        if not (np.all(np.isfinite(speeds)) and np.all(np.isfinite(rates))):
            raise NotFiniteError("A speed or turn rate of the robot is not finite; leave it out.")
        seconds = np.diff(np.asarray(stamps_ns, dtype=np.int64)) * NS
        screws = tuple(
            Screw.of_rates((speed, 0.0, 0.0), rate, dt)
            for speed, rate, dt in zip(_means(speeds), _means(rates), seconds.tolist(), strict=True)
        )
        poses = [SE3.identity()]
        for screw in screws:
            poses.append(poses[-1] @ screw.pose())
        return MotionTrack(tuple(stamps_ns), tuple(poses), screws)

    def T_still_base(self, stamp_ns: int) -> SE3:
        """Pose then; before the first and after the last one the motion goes on as it was."""
        i = self.interval(stamp_ns)
        return self.poses[i] @ self.screws[i].pose(self.part(i, stamp_ns))

    def interval(self, stamp_ns: int) -> int:
        """Index of the screw that holds then."""
        return min(max(bisect_right(self.stamps_ns, stamp_ns) - 1, 0), len(self.screws) - 1)

    def part(self, i: int, stamp_ns: int) -> float:
        """Of interval i; outside [0, 1] before and after it."""
        return (stamp_ns - self.stamps_ns[i]) / (self.stamps_ns[i + 1] - self.stamps_ns[i])


def _means(values: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.asarray((values[1:] + values[:-1]) / 2.0)


def _refuse_stamps(stamps_ns: Sequence[int], count: int) -> None:
    if len(stamps_ns) != count or count < 2:
        raise InputError("A track of motion needs a stamp for each of at least two samples.")
    if any(after <= before for before, after in pairwise(stamps_ns)):
        raise InputError("The stamps of a track of motion must grow; sort them and leave out what came twice.")
