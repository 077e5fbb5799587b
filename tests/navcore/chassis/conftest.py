"""Guard and simulated chassis, wired together in one thread with a clock that the test turns."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from navcore.chassis.guard import Frames, Guard, GuardParams
from navcore.chassis.protocol import GuardRequest, GuardState, MotionCommand
from navcore.chassis.scout_can import MOTION_COMMAND, Frame, decode_motion_command
from navcore.sim.scout_ecu import ScoutEcu, ScoutEcuParams
from navcore.sim.vehicle_dynamics import WheelState

MS = 1_000_000
STEP_MS = 5
LAG_S = 0.1


class Bench:
    """Time passes in steps of 5 ms; commands and ticks come every 20 ms.

    Attributes:
        sent: (time in ns, frame) of all that left the guard.
        lost: identifiers of feedback frames that get lost on the way to the guard.
    """

    def __init__(self, ecu: ScoutEcuParams | None = None, guard: GuardParams | None = None) -> None:
        self.guard = Guard(guard)
        self.ecu = ScoutEcu(ecu)
        self.now_ns = 1_000 * MS
        self.sent: list[tuple[int, Frame]] = []
        self.lost: set[int] = set()
        self.seq = 0
        self.v = self.omega = 0.0

    def state(self) -> GuardState:
        return self.guard.state

    def send(self, frames: Frames) -> Frames:
        for frame in frames:
            self.sent.append((self.now_ns, frame))
            self.ecu.receive(frame, self.now_ns)
        return frames

    def command(self, v: float, omega: float = 0.0, age_ms: int = 0, lifetime_ms: int = 300) -> MotionCommand:
        self.seq += 1
        stamp_ns = self.now_ns - age_ms * MS
        deadline_ns = stamp_ns + lifetime_ms * MS
        return MotionCommand(v=v, omega=omega, seq=self.seq, stamp_ns=stamp_ns, deadline_ns=deadline_ns)

    def order(self, v: float, omega: float = 0.0) -> Frames:
        return self.send(self.guard.on_command(self.command(v, omega), self.now_ns))

    def ask(self, request: GuardRequest) -> Frames:
        return self.send(self.guard.on_request(request, self.now_ns, self.now_ns))

    def pass_time(self, ms: int, drive: tuple[float, float] | None = None) -> None:
        for _ in range(ms // STEP_MS):
            self.now_ns += STEP_MS * MS
            self._turn_wheels()
            self._tell()
            if self.now_ns % (20 * MS) == 0:
                self.send(self.guard.tick(self.now_ns))
                if drive is not None:
                    self.order(*drive)

    def arm(self) -> None:
        self.pass_time(200)
        self.ask(GuardRequest.ARM)
        for _ in range(400):
            if self.guard.state is not GuardState.SILENT:
                return
            self.pass_time(STEP_MS)

    def drive(self, v: float = 0.8) -> None:
        """Armed and at speed."""
        self.arm()
        self.pass_time(2000, drive=(v, 0.0))

    def speeds_sent(self, since_ns: int = 0) -> list[tuple[float, float]]:
        motion = [decode_motion_command(f) for at, f in self.sent if at >= since_ns and f.can_id == MOTION_COMMAND]
        return [speeds for speeds in motion if speeds is not None]

    def _turn_wheels(self) -> None:
        v, omega = self.ecu.target(self.now_ns)
        share = STEP_MS * 1e-3 / LAG_S
        self.v += (v - self.v) * share
        self.omega += (omega - self.omega) * share

    def _tell(self) -> None:
        wheels = WheelState(
            stamp_ns=self.now_ns, left=self.v, right=self.v, left_m=0.0, right_m=0.0, v=self.v, omega=self.omega
        )
        for frame in self.ecu.feedback(self.now_ns, wheels):
            if frame.can_id not in self.lost:
                self.send(self.guard.on_frame(frame, self.now_ns))


@pytest.fixture
def bench() -> Bench:
    return Bench()


@pytest.fixture
def make_bench() -> Callable[[ScoutEcuParams], Bench]:
    return Bench
