"""What the navigator knows of the robot itself: pose, motion, chassis, and how fresh each of them is."""

from __future__ import annotations

import math

from navcore.chassis.protocol import ChassisState, ControlMode, GuardState
from navcore.geometry.se2 import SE2
from navcore.localization.attitude import Attitude
from navcore.localization.independent_check import IndependentCheck
from navcore.localization.pose_filter import PoseFilter
from navcore.messages import CameraName, FixQuality, NavInputs, PoseEstimate, RowObservation, ToldPlace
from navcore.mission.camera_truth import CameraTruth
from navcore.mission.evidence import NS, GnssEvidence
from navcore.mission.map_evidence import MapEvidence
from navcore.mission.placing import Placing

STANDING_V = 0.03
STANDING_OMEGA = 0.05


class Senses:
    """Feeds the pose filter and keeps the newest of everything else."""

    def __init__(
        self, pose_filter: PoseFilter, gnss: GnssEvidence, attitude: Attitude, check: IndependentCheck,
        on_map: MapEvidence,
    ) -> None:  # fmt: skip
        self.filter = pose_filter
        self.check = check
        self.attitude = attitude
        self.gnss = gnss
        self.on_map = on_map
        self.placing = Placing()
        self.chassis: ChassisState | None = None
        self.pose: PoseEstimate | None = None
        self.T_odom_base = SE2(0.0, 0.0, 0.0)
        self.camera = CameraTruth()

    def take(self, inputs: NavInputs) -> None:
        """Predict and correct with all that this tick consumed."""
        for sample in inputs.imu:
            self.filter.add_imu(sample)
            self.attitude.add_imu(sample)
            self.filter.lean(self.attitude.roll)
            self.check.add_imu(sample)
        for state in inputs.chassis:
            self.chassis = state
            self.filter.add_chassis(state)
            self.attitude.add_speed(state.v)
            self.check.add_chassis(state)
        for fix in inputs.gnss:
            self.gnss.add(fix)
            self.filter.add_gnss(fix)
            self.check.add_gnss(fix)
            self.on_map.add_fix(fix, self.filter.odom_at(fix.stamp_ns))
            if fix.quality is FixQuality.RTK_FIXED and fix.height_m is not None and math.isfinite(fix.height_m):
                self.attitude.see_height(fix.height_m)
        for match in inputs.matches:
            if self.on_map.add(match, self.filter.odom_at(match.stamp_ns)):
                self.filter.add_match(match)
        self.pose = self.filter.estimate(inputs.now_ns)
        if self.pose is not None:
            self.check.add_estimate(self.pose)
            self.placing.forget()
        before, self.T_odom_base = self.T_odom_base, self.filter.odom_at(inputs.now_ns)
        self.attitude.drive(self.T_odom_base.x - before.x, self.T_odom_base.y - before.y, self.T_odom_base.yaw)
        for row in inputs.rows:
            self._take_lean(row)
            self.camera.take(row)

    def place(self, now_ns: int, place: ToldPlace) -> None:
        """An operator says where the robot stands: the 3D map is searched there, and weak fixes count no more."""
        self.placing.hear(now_ns, place, self.T_odom_base)
        self.filter.wait_for_map("the 3D map is searched where the operator has put the robot")
        self.pose = None

    def _take_lean(self, row: RowObservation) -> None:
        """The rear camera leans to its right where the robot leans to its left."""
        if row.lean is not None and row.lean_std is not None:
            side = -1.0 if row.camera is CameraName.REAR else 1.0
            self.attitude.see_lean(self.T_odom_base.yaw, side * row.lean, row.lean_std)

    @property
    def drift(self) -> float:
        """Direction in which the robot goes on this land while it points straight ahead, rad in `base_link`."""
        return self.filter.drift(self.attitude.land_roll(self.T_odom_base.yaw))

    @property
    def wheel_omega(self) -> float | None:
        """Turn rate that the wheels tell, rad/s: more than a skid-steered robot turns. None if they tell none."""
        c = self.chassis
        return c.omega if c is not None and math.isfinite(c.omega) else None

    @property
    def T_map_base(self) -> SE2 | None:
        """The filter's pose, None before it has one."""
        return SE2(self.pose.x, self.pose.y, self.pose.yaw) if self.pose else None

    @property
    def pose_std(self) -> float | None:
        """1-sigma of the position, m: the larger half axis of its ellipse."""
        if self.pose is None:
            return None
        xx, xy, yy = self.pose.covariance[0], self.pose.covariance[1], self.pose.covariance[4]
        mean, difference = (xx + yy) / 2, (xx - yy) / 2
        return math.sqrt(max(mean + math.hypot(difference, xy), 0.0))

    @property
    def standing(self) -> bool:
        """The chassis says that it does not move."""
        c = self.chassis
        return c is not None and abs(c.v) < STANDING_V and abs(c.omega) < STANDING_OMEGA

    @property
    def armed(self) -> bool:
        """The guard lets motion out and the chassis obeys."""
        c = self.chassis
        return c is not None and c.guard is GuardState.ARMED and c.mode is ControlMode.CAN

    @property
    def gnss_quality(self) -> FixQuality:
        """Quality of the newest epoch with a position."""
        return self.gnss.newest.quality if self.gnss.newest else FixQuality.NONE

    def chassis_age_s(self, now_ns: int) -> float | None:
        """Age of the newest motion feedback."""
        return None if self.chassis is None else (now_ns - self.chassis.stamp_ns) * NS

    def system_age_s(self, now_ns: int) -> float | None:
        """Age of the newest system state."""
        return None if self.chassis is None else (now_ns - self.chassis.system_stamp_ns) * NS
