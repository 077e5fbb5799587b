"""What the chassis last said of itself, and whether that forbids motion. Pure, with time as an argument."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.chassis import scout_can
from navcore.chassis.protocol import ChassisState, ControlMode, GuardState, VehicleState
from navcore.chassis.scout_can import Frame, SystemState

MS = 1_000_000
NEVER_HEARD = SystemState(state=VehicleState.EXCEPTION, mode=ControlMode.STANDBY, voltage_v=0.0, faults=0)


@dataclass(frozen=True, slots=True, kw_only=True)
class FeedbackParams:
    """What counts as a living, standing chassis.

    Attributes:
        motion_state_ms: longest time without 0x221, whose period is 20 ms; > 20.
        system_state_ms: longest time without 0x211, whose period is 100 ms; > 100.
        still_speed: below this |v| (m/s) and |omega| (rad/s) the robot stands; > 0.001, the unit of 0x221.
    """

    motion_state_ms: int = 200
    system_state_ms: int = 500
    still_speed: float = 0.02


class ChassisFeedback:
    """Newest value of each feedback frame, and when it arrived."""

    def __init__(self, params: FeedbackParams | None = None) -> None:
        self.params = params or FeedbackParams()
        self.system = NEVER_HEARD
        self.system_ns: int | None = None
        self._motion = (0.0, 0.0)
        self._motion_ns: int | None = None
        self._odometer_mm = (0, 0)
        self._driver_faults = (0, 0, 0, 0)

    def take(self, frame: Frame, now_ns: int) -> None:
        """Take in one frame; frames of others are ignored."""
        if (speeds := scout_can.decode_motion_state(frame)) is not None:
            self._motion, self._motion_ns = speeds, now_ns
        elif (odometer := scout_can.decode_odometer(frame)) is not None:
            self._odometer_mm = odometer
        elif (system := scout_can.decode_system_state(frame)) is not None:
            self.system, self.system_ns = system, now_ns
        elif (motor := scout_can.decode_motor_slow(frame)) is not None:
            first, second, third, fourth = (
                motor.state if number == motor.motor else old for number, old in enumerate(self._driver_faults)
            )
            self._driver_faults = (first, second, third, fourth)

    def fault(self, now_ns: int) -> str:
        """What forbids motion, empty if nothing does."""
        if not self._measures_speed(now_ns):
            return "The chassis does not report its speed (0x221). Check the CAN cable."
        if self.system_ns is None or now_ns - self.system_ns > self.params.system_state_ms * MS:
            return "The chassis does not report its state (0x211). Check the CAN cable."
        if self.system.state is VehicleState.EMERGENCY_STOP:
            return "The emergency stop on the robot is pressed."
        if self.system.state is VehicleState.EXCEPTION:
            return "The chassis reports a fault of its own."
        if self.system.mode is ControlMode.REMOTE:
            return "The remote control has taken over."
        if self.system.mode is ControlMode.SERIAL:
            return "The chassis is under serial control."
        return ""

    def stands(self, now_ns: int) -> bool:
        """True if the chassis says now that it does not move."""
        return self._measures_speed(now_ns) and max(map(abs, self._motion)) < self.params.still_speed

    def obeys(self) -> bool:
        """True if the chassis takes motion frames, so that they disturb nobody else's."""
        return self.system.mode is ControlMode.CAN

    def chassis_state(self, guard: GuardState, guard_reason: str, accepted_seq: int) -> ChassisState:
        """What chassis and guard have to say now."""
        return ChassisState(
            stamp_ns=self._motion_ns or 0, system_stamp_ns=self.system_ns or 0, v=self._motion[0],
            omega=self._motion[1], left_mm=self._odometer_mm[0], right_mm=self._odometer_mm[1],
            state=self.system.state, mode=self.system.mode, voltage_v=self.system.voltage_v,
            faults=self.system.faults, driver_faults=self._driver_faults, guard=guard, guard_reason=guard_reason,
            accepted_seq=accepted_seq,
        )  # fmt: skip

    def _measures_speed(self, now_ns: int) -> bool:
        return self._motion_ns is not None and now_ns - self._motion_ns <= self.params.motion_state_ms * MS
