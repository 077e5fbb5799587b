"""What the guard is told: a numbered command with its deadline, and when to arm, disarm or forget a latch."""

from __future__ import annotations

from navcore.chassis.protocol import GuardRequest, GuardState, MotionCommand
from navcore.messages import RequestKind, RunState
from navcore.mission.driver import Driving
from navcore.mission.senses import Senses
from navcore.mission.state_machine import MOVING

MS = 1_000_000
GO_ON = (RequestKind.START, RequestKind.RESUME, RequestKind.ACKNOWLEDGE)


class GuardOrders:
    """The navigator's words to the guard. Silence means stop."""

    def __init__(self, command_ms: int) -> None:
        """`command_ms` is the longest life of a command, ms, whatever its evidence."""
        self._longest_ns = command_ms * MS
        self._seq = 0

    def command(self, now_ns: int, state: RunState, driving: Driving, senses: Senses) -> MotionCommand | None:
        """Zero unless driving; nothing at all while the guard does not listen."""
        if not senses.armed:
            return None
        v, omega, deadline_ns = 0.0, 0.0, now_ns + self._longest_ns
        if state is RunState.DRIVING:
            v, omega, deadline_ns = driving.v, driving.omega, min(driving.deadline_ns, deadline_ns)
        self._seq += 1
        return MotionCommand(v=v, omega=omega, seq=self._seq, stamp_ns=now_ns, deadline_ns=deadline_ns)

    def request(self, state: RunState, asked: RequestKind | None, senses: Senses) -> GuardRequest | None:
        """ARM until armed, DISARM at rest, ACKNOWLEDGE when the operator who was shown the latch goes on."""
        chassis = senses.chassis
        latched = chassis is not None and chassis.guard is GuardState.LATCHED
        if latched and asked in GO_ON:
            return GuardRequest.ACKNOWLEDGE
        if state is RunState.STARTING and not senses.armed:
            return GuardRequest.ARM
        resting = state not in MOVING and state is not RunState.PAUSED
        return GuardRequest.DISARM if resting and senses.armed and senses.standing else None
