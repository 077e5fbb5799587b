"""The front of mapping: turns of the LiDAR, laid one on the other, become keyframes."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.localization.lidar3d.deskew import Deskew, DeskewParams
from navcore.localization.motion_track import MotionTrack
from navcore.mapping.lidar3d.drive import Drive, Sensed
from navcore.mapping.lidar3d.fix_placing import FixPlacer, FixPlacerParams
from navcore.mapping.lidar3d.keyframe import Keyframe
from navcore.mapping.lidar3d.motion import Motion, MotionParams
from navcore.mapping.lidar3d.scan_tracker import ScanTracker, ScanTrackerParams, Tracked
from navcore.mapping.lidar3d.voxel_cloud import VoxelCloud
from navcore.messages import NavInputs
from navcore.messages.cloud import LidarCloud, unpacked

Floats = NDArray[np.float64]
_NS = 1e-9
# How finely the robot's motion over a turn is told, ns.
_KNOT_NS = 25_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class KeyframeMakerParams:
    """Parameters of `KeyframeMaker`.

    Attributes:
        apart, turned: a keyframe after so much way, m, or turn, rad; above 0.
        settle_s: a turn waits so long for odometry and IMU to come in, s, 0 to 1.
        nearest, farthest: points that are kept, m from the sensor: nearer ones are the robot, farther ones sparse.
        scan_voxel: edge of the voxels of a scan that is matched, m. keyframe_voxel: of what a keyframe keeps.
        still, still_turn: with less motion since the last turn, a turn says nothing new, m and rad.
        motion, tracker, fixes, deskew: of each step.
    """

    apart: float = 1.0
    turned: float = math.radians(15.0)
    settle_s: float = 0.05
    nearest: float = 1.0
    farthest: float = 50.0
    scan_voxel: float = 0.3
    keyframe_voxel: float = 0.1
    still: float = 0.002
    still_turn: float = math.radians(0.1)
    motion: MotionParams = field(default_factory=MotionParams)
    tracker: ScanTrackerParams = field(default_factory=ScanTrackerParams)
    fixes: FixPlacerParams = field(default_factory=FixPlacerParams)
    deskew: DeskewParams = field(default_factory=DeskewParams)


@dataclass(slots=True)
class _SoFar:
    """Since the last keyframe. All of it is empty when a keyframe has just been made, so a new start from a keyframe
    goes on exactly as if there had been none.
    """

    clouds: VoxelCloud
    stamps_ns: list[int]
    poses: list[SE3]
    scans: int = 0
    lost: int = 0
    score: float = 0.0


class KeyframeMaker:
    """Feed it a drive from its begin; it goes on after the keyframes that are known.

    Attributes:
        turns: of the LiDAR that were taken in, those before the known keyframes included.
        blurred: turns that were left out, since the robot's motion during them is not known.
    """

    def __init__(
        self, drive: Drive, known: Sequence[Keyframe] = (), params: KeyframeMakerParams = KeyframeMakerParams()
    ) -> None:
        self._params, self._T_base_lidar = params, drive.rig.T_base_lidar()
        self._motion, self._tracker = Motion(params.motion), ScanTracker(self._T_base_lidar.t, params.tracker)
        self._fixes = FixPlacer(drive.datum, drive.rig.antenna, params.fixes)
        self._deskew = Deskew(self._T_base_lidar, params.deskew)
        self._waiting: deque[LidarCloud] = deque()
        self._last = known[-1] if known else None
        self._resumed_ns = -1 if self._last is None else self._last.stamp_ns
        self._tracker.add(*known[-params.tracker.keyframes - 1 :])
        self._so_far = self._fresh()
        self.turns = self.blurred = 0

    def add(self, sensed: Sensed) -> Iterator[Keyframe]:
        """Take in the next of the drive: keyframes that come of it."""
        if isinstance(sensed, LidarCloud):
            self._waiting.append(sensed)
            return
        self._motion.add(sensed)
        self._fixes.add(sensed.gnss)
        yield from self._due(sensed)

    def _due(self, inputs: NavInputs) -> Iterator[Keyframe]:
        ready_ns = inputs.now_ns - round(self._params.settle_s / _NS)
        while self._waiting and self._waiting[0].stamp_ns <= ready_ns:
            keyframe = self._turn(self._waiting.popleft())
            if keyframe is not None:
                yield keyframe

    def _turn(self, message: LidarCloud) -> Keyframe | None:
        self.turns += 1
        if message.stamp_ns <= self._resumed_ns:
            self._fixes.clear()
            return None
        newest = self._so_far.stamps_ns[-1] if self._so_far.stamps_ns else None
        if newest is not None and (message.stamp_ns <= newest or self._stands(newest, message.stamp_ns)):
            return None
        points = self._points(message)
        if points is None:
            self.blurred += 1
            return None
        self._take(message.stamp_ns, points, self._placed(message.stamp_ns, points[0]))
        return self._keyframe() if self._is_due() else None

    def _stands(self, from_ns: int, to_ns: int) -> bool:
        step = self._motion.step(from_ns, to_ns)
        return float(np.linalg.norm(step.t)) < self._params.still and step.angle() < self._params.still_turn

    def _points(self, message: LidarCloud) -> tuple[Floats, PointCloud] | None:
        """Points (N, 3) in `base_link` at the stamp, m, and their cloud; None where the motion is not known."""
        cloud = unpacked(message)
        away = np.einsum("ij,ij->i", cloud.points, cloud.points)
        kept = cloud.where((away >= self._params.nearest**2) & (away <= self._params.farthest**2))
        still = self._deskew.process(kept, message.stamp_ns, self._track(message.stamp_ns, kept.times)).cloud
        return None if still is None else (self._T_base_lidar.apply(still.points), still)

    def _track(self, stamp_ns: int, times: Floats) -> MotionTrack:
        """Over the turn that ends then."""
        turn_ns = round(-float(times.min(initial=0.0)) / _NS)
        stamps = [stamp_ns - n * _KNOT_NS for n in range(turn_ns // _KNOT_NS + 1, -1, -1)]
        return MotionTrack.of_poses(stamps, [self._motion.step(stamps[0], ns) for ns in stamps])

    def _placed(self, stamp_ns: int, points: Floats) -> Tracked:
        scan = voxel_means(points, self._params.scan_voxel)
        if self._last is None:
            return self._tracker.place(scan, SE3(_levelled(self._motion.up(stamp_ns)), np.zeros(3)))
        guess = self._so_far.poses[-1] @ self._motion.step(self._so_far.stamps_ns[-1], stamp_ns)
        return self._tracker.place(scan, guess)

    def _take(self, stamp_ns: int, points: tuple[Floats, PointCloud], tracked: Tracked) -> None:
        s = self._so_far
        s.clouds.add(tracked.T_odom_base.apply(points[0]), points[1].intensities)
        s.stamps_ns.append(stamp_ns)
        s.poses.append(tracked.T_odom_base)
        s.scans, s.lost, s.score = s.scans + 1, s.lost + (not tracked.held), s.score + tracked.score
        self._tracked = tracked

    def _is_due(self) -> bool:
        if self._last is None:
            return True
        way = self._last.T_odom_base.inverse() @ self._so_far.poses[-1]
        return float(np.linalg.norm(way.t)) >= self._params.apart or way.angle() >= self._params.turned

    def _keyframe(self) -> Keyframe:
        s, T = self._so_far, self._so_far.poses[-1]
        way = 0.0 if self._last is None else float(np.linalg.norm(T.t - self._last.T_odom_base.t))
        track = MotionTrack.of_poses(s.stamps_ns, s.poses) if len(s.poses) > 1 else None
        keyframe = Keyframe(
            stamp_ns=s.stamps_ns[-1], driven=way + (self._last.driven if self._last else 0.0), T_odom_base=T,
            covariance=self._tracked.covariance, up=self._motion.up(s.stamps_ns[-1]),
            points=T.inverse().apply(s.clouds.points).astype(np.float32), intensities=s.clouds.intensities,
            fix=self._fixes.best(track, T), scans=s.scans, lost=s.lost, score=s.score / s.scans,
        )  # fmt: skip
        self._last = keyframe
        self._tracker.add(keyframe)
        self._so_far = self._fresh()
        return keyframe

    def _fresh(self) -> _SoFar:
        """Begins at the last keyframe."""
        clouds = VoxelCloud(self._params.keyframe_voxel)
        if self._last is None:
            return _SoFar(clouds, [], [])
        return _SoFar(clouds, [self._last.stamp_ns], [self._last.T_odom_base])


def _levelled(up: Floats) -> Floats:
    """Rotation (3, 3) with no yaw that lays `up` on z."""
    roll, pitch = math.atan2(up[1], up[2]), -math.asin(min(max(float(up[0]), -1.0), 1.0))
    return SE3.from_rpy((0.0, 0.0, 0.0), roll=roll, pitch=pitch).R
