"""The chassis' side of the bus: what an AgileX Scout 2.0 does with frames, pure, with time as an argument.

Source: Scout user manual 1.3.0 (protocol 2.0). What the manual leaves open, whether motion resumes by itself when
frames return after the timeout, is a parameter: both must be survived. Lag, slip and the ground are not here.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

from navcore.chassis import scout_can
from navcore.chassis.protocol import ControlMode, VehicleState
from navcore.chassis.scout_can import Frame
from navcore.sim.vehicle_dynamics import WheelState

MS = 1_000_000
STOPPED = (0.0, 0.0)
VERSION = scout_can.Version(
    controller_hardware=(2, 0), driver_hardware=(2, 0), controller_software=(3, 0), driver_software=(2, 1)
)


@dataclass(frozen=True, slots=True, kw_only=True)
class ScoutEcuParams:
    """Behaviour of the chassis.

    Attributes:
        command_timeout_ms: without 0x111 the target becomes zero (table 3.4: 500 ms).
        resumes: after the timeout a new 0x111 moves it again at once; else only after a new 0x421.
        fast_ms: period of 0x221, 0x251 to 0x254 and 0x311 (20 ms).
        system_ms: period of 0x211 (100 ms).
        slow_ms: period of 0x261 to 0x264 and 0x361 (the CAN table says 20 ms, the serial table 100 ms).
        voltage_v: 22 to 29.2 V.
        wheel_diameter: m, > 0.
        gear: motor turns per wheel turn (data sheet 1:32).
        pulses_per_turn: encoder pulses per motor turn, assumed.
    """

    command_timeout_ms: int = 500
    resumes: bool = True
    fast_ms: int = 20
    system_ms: int = 100
    slow_ms: int = 100
    voltage_v: float = 26.4
    wheel_diameter: float = 0.30
    gear: float = 32.0
    pulses_per_turn: float = 1024.0


class Schedule:
    """Says when something periodic is due; what was missed is not caught up."""

    def __init__(self, period_ms: int) -> None:
        self._period_ns = period_ms * MS
        self._next_ns: int | None = None

    def due(self, now_ns: int) -> bool:
        """True once per period."""
        if self._next_ns is not None and now_ns < self._next_ns:
            return False
        late = self._next_ns is None or now_ns - self._next_ns >= self._period_ns
        self._next_ns = (now_ns if late or self._next_ns is None else self._next_ns) + self._period_ns
        return True


class ScoutEcu:
    """Standby at boot, obeys 0x421 alone until CAN mode, stops on silence, e-stop or takeover."""

    def __init__(self, params: ScoutEcuParams | None = None) -> None:
        self.params = params or ScoutEcuParams()
        self.mode = ControlMode.STANDBY
        self.state = VehicleState.NORMAL
        self.faults = 0
        self._driver_faults = [0] * scout_can.MOTORS
        self._remote = STOPPED
        self._wanted = STOPPED
        self._wanted_ns: int | None = None
        self._protected = False
        self._counter = 0
        self._answers: list[Frame] = []
        self._fast = Schedule(self.params.fast_ms)
        self._system = Schedule(self.params.system_ms)
        self._slow = Schedule(self.params.slow_ms)

    def receive(self, frame: Frame, now_ns: int) -> None:
        """Take one frame off the bus."""
        if (mode := scout_can.decode_control_mode(frame)) is not None:
            self._set_mode(mode)
        elif (wanted := scout_can.decode_motion_command(frame)) is not None:
            self._protect_if_late(now_ns)
            if self.mode is ControlMode.CAN:
                self._wanted, self._wanted_ns = wanted, now_ns
        elif frame == scout_can.encode_version_request():
            self._answers.append(scout_can.encode_version(VERSION))
        elif frame.can_id == scout_can.CLEAR_ERRORS and len(frame.data) == 1:
            self._clear(frame.data[0])

    def target(self, now_ns: int) -> tuple[float, float]:
        """(v, omega) that the motors are to reach now, m/s and rad/s."""
        if self.state is not VehicleState.NORMAL:
            return STOPPED
        if self.mode is ControlMode.REMOTE:
            return self._remote
        self._protect_if_late(now_ns)
        if self.mode is not ControlMode.CAN or self._protected or self._wanted_ns is None:
            return STOPPED
        return self._wanted

    def feedback(self, now_ns: int, wheels: WheelState) -> list[Frame]:
        """Frames that are due now. To be called at least every 20 ms."""
        frames, self._answers = self._answers, []
        if self._fast.due(now_ns):
            frames.append(scout_can.encode_motion_state(wheels.v, wheels.omega))
            frames.append(scout_can.encode_odometer(round(wheels.left_m * 1000), round(wheels.right_m * 1000)))
            frames += [scout_can.encode_motor_fast(self._motor_fast(motor, wheels)) for motor in range(4)]
        if self._slow.due(now_ns):
            frames += [scout_can.encode_motor_slow(self._motor_slow(motor)) for motor in range(4)]
        if self._system.due(now_ns):
            frames.append(self._system_state())
        return frames

    def press_emergency_stop(self, pressed: bool) -> None:
        """The button on the robot. Released, the chassis is as before, mode and all."""
        self.state = VehicleState.EMERGENCY_STOP if pressed else VehicleState.NORMAL

    def take_over(self, stick: tuple[float, float] | None) -> None:
        """The remote control drives with (v, omega), or gives back with None."""
        self._remote = stick or STOPPED
        self.mode = ControlMode.STANDBY if stick is None else ControlMode.REMOTE
        self._wanted_ns = None

    def break_driver(self, motor: int, bits: int) -> None:
        """Fault bits of a motor driver (0 to 3), latched until 0x441."""
        self._driver_faults[motor] |= bits
        self.state = VehicleState.EXCEPTION

    def reboot(self) -> None:
        """Power returned: standby, and nothing remembered."""
        self.mode, self.state = ControlMode.STANDBY, VehicleState.NORMAL
        self._wanted_ns, self._protected = None, False
        self._driver_faults = [0] * scout_can.MOTORS

    def _set_mode(self, mode: ControlMode) -> None:
        if self.mode is ControlMode.REMOTE:  # the remote has priority
            return
        self.mode, self._wanted_ns, self._protected = mode, None, False

    def _protect_if_late(self, now_ns: int) -> None:
        """Communication protection: silence stops, and what ends it depends on the variant."""
        late = self._wanted_ns is not None and now_ns - self._wanted_ns > self.params.command_timeout_ms * MS
        if late:
            self._wanted_ns = None
            self._protected = not self.params.resumes

    def _clear(self, motor: int) -> None:
        for number in range(scout_can.MOTORS):
            if motor in (0, number + 1):
                self._driver_faults[number] = 0
        if self.state is VehicleState.EXCEPTION and not any(self._driver_faults):
            self.state = VehicleState.NORMAL

    def _motor_fast(self, motor: int, wheels: WheelState) -> scout_can.MotorFast:
        """Motors 0 and 3 drive the right side."""
        right = motor in (0, 3)
        turns = self.params.gear / (pi * self.params.wheel_diameter)
        pulses = round((wheels.right_m if right else wheels.left_m) * turns * self.params.pulses_per_turn)
        rpm = round((wheels.right if right else wheels.left) * turns * 60)
        wrapped = (pulses + 2**31) % 2**32 - 2**31
        return scout_can.MotorFast(motor=motor, rpm=rpm, current_a=0.0, pulses=wrapped)

    def _motor_slow(self, motor: int) -> scout_can.MotorSlow:
        return scout_can.MotorSlow(
            motor=motor, voltage_v=self.params.voltage_v, driver_temperature_c=35, motor_temperature_c=40,
            state=self._driver_faults[motor],
        )  # fmt: skip

    def _system_state(self) -> Frame:
        self._counter = (self._counter + 1) % 256
        system = scout_can.SystemState(
            state=self.state, mode=self.mode, voltage_v=self.params.voltage_v, faults=self.faults,
            counter=self._counter,
        )  # fmt: skip
        return scout_can.encode_system_state(system)
