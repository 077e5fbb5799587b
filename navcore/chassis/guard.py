"""The last word before the wire: SILENT -> ARMED -> LATCHED, pure, with time as an argument.

Motion leaves only as the immediate answer to one fresh command while ARMED. Anything unexpected latches: zero frames
go out until the robot stands, and nothing moves again before an operator has acknowledged and started anew.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field

from navcore.chassis import scout_can
from navcore.chassis.feedback import MS, ChassisFeedback, FeedbackParams
from navcore.chassis.limits import LimitParams, is_finite, limit
from navcore.chassis.protocol import ChassisState, ControlMode, GuardRequest, GuardState, MotionCommand
from navcore.chassis.scout_can import Frame

Frames = tuple[Frame, ...]
ZERO = scout_can.encode_motion_command(0.0, 0.0)
ENABLE = scout_can.encode_control_mode(ControlMode.CAN)
READY = "Waiting for a start."


@dataclass(frozen=True, slots=True, kw_only=True)
class GuardParams:
    """Times of the guard, ms, all > 0.

    Attributes:
        limits, feedback: see there.
        silence_ms: longest time between accepted commands; below the chassis' own 500 ms (Scout manual, table 3.4).
        first_command_ms: the same, right after arming.
        request_age_ms: an older request is not obeyed.
        enable_ms: for the chassis to enter CAN mode.
        zeros_ms: of zero frames between CAN mode and ARMED, and of standstill that ends the zeros after a stop.
        longest_zeros_ms: of zero frames if the chassis never reports standstill.
        flood_window_ms, flood_count: more commands than this in the window latch (nominal: 12.5 in 250 ms).
    """

    limits: LimitParams = field(default_factory=LimitParams)
    feedback: FeedbackParams = field(default_factory=FeedbackParams)
    silence_ms: int = 200
    first_command_ms: int = 500
    request_age_ms: int = 200
    enable_ms: int = 1000
    zeros_ms: int = 500
    longest_zeros_ms: int = 5000
    flood_window_ms: int = 250
    flood_count: int = 25


class Guard:
    """State machine between commands and frames. Each call returns the frames to send now, never more than one."""

    def __init__(self, params: GuardParams | None = None) -> None:
        self.params = params or GuardParams()
        self.state = GuardState.SILENT
        self.reason = READY
        self._feedback = ChassisFeedback(self.params.feedback)
        self._arming_since_ns: int | None = None
        self._enabled_since_ns: int | None = None
        self._zeros_since_ns: int | None = None
        self._still_since_ns: int | None = None
        self._armed_since_ns = self._expires_ns = self._sent_ns = 0
        self._sent = (0.0, 0.0)
        self._accepted_seq = -1
        self._arrivals: deque[int] = deque()

    def tick(self, now_ns: int) -> Frames:
        """To be called every 20 ms, and before anything is handed in that may have waited in a queue."""
        if stopping := self._stop_if_due(now_ns):
            return stopping
        if self._arming_since_ns is not None:
            return self._continue_arming(self._arming_since_ns, now_ns)
        return self._zero_until_still(now_ns)

    def on_command(self, command: MotionCommand, now_ns: int) -> Frames:
        """One motion frame for an accepted command, none for a refused one."""
        stopping = self._stop_if_due(now_ns)
        if self.state is not GuardState.ARMED:
            return stopping
        if self._is_flood(now_ns):
            return self._latch("The navigator floods the guard with commands.", now_ns)
        if not is_finite(command.v, command.omega):
            return self._latch("The navigator sent a command that is no number.", now_ns)
        self.reason = self._refusal(command, now_ns)
        return () if self.reason else self._accept(command, now_ns)

    def on_request(self, request: GuardRequest, stamp_ns: int, now_ns: int) -> Frames:
        """Arm, disarm or acknowledge; a request from the past or the future is ignored."""
        if not 0 <= now_ns - stamp_ns <= self.params.request_age_ms * MS:
            return ()
        if request is GuardRequest.ARM:
            return self._begin_arming(now_ns)
        if request is GuardRequest.DISARM:
            return self._disarm(now_ns)
        if self.state is GuardState.LATCHED:
            self._leave(GuardState.SILENT, READY)
        return ()

    def on_stop(self, now_ns: int) -> Frames:
        """STOP wins in every state."""
        return self._latch("Stopped by an operator.", now_ns) or self._start_zeros(now_ns)

    def on_bus_error(self, text: str, now_ns: int) -> Frames:
        """The bus failed; what is returned may still be tried."""
        return self._latch(f"The CAN bus failed: {text}", now_ns)

    def on_frame(self, frame: Frame, now_ns: int) -> Frames:
        """Take in what the chassis says."""
        self._feedback.take(frame, now_ns)
        return self._stop_if_due(now_ns)

    def chassis_state(self) -> ChassisState:
        """What chassis and guard have to say now."""
        return self._feedback.chassis_state(self.state, self.reason, self._accepted_seq)

    def _refusal(self, command: MotionCommand, now_ns: int) -> str:
        """Why a finite command is not obeyed, empty if it is. A stamp in the future would stay fresh for ever."""
        if command.seq <= self._accepted_seq:
            return f"Command {command.seq} came after {self._accepted_seq}."
        if not self._armed_since_ns <= command.stamp_ns <= now_ns:
            return f"Command {command.seq} was decided before arming or in the future."
        if not now_ns <= command.deadline_ns:
            return f"Command {command.seq} was past its deadline."
        return ""

    def _accept(self, command: MotionCommand, now_ns: int) -> Frames:
        elapsed_s = (now_ns - self._sent_ns) * 1e-9
        self._sent = limit((command.v, command.omega), self._sent, elapsed_s, self.params.limits)
        self._sent_ns = now_ns
        self._accepted_seq = command.seq
        self._expires_ns = min(command.deadline_ns, now_ns + self.params.silence_ms * MS)
        return (scout_can.encode_motion_command(*self._sent),)

    def _is_flood(self, now_ns: int) -> bool:
        self._arrivals.append(now_ns)
        while now_ns - self._arrivals[0] > self.params.flood_window_ms * MS:
            self._arrivals.popleft()
        return len(self._arrivals) > self.params.flood_count

    def _stop_if_due(self, now_ns: int) -> Frames:
        """Latch if motion is possible now but no longer justified."""
        if self.state is not GuardState.ARMED and self._arming_since_ns is None:
            return ()
        fault = self._feedback.fault(now_ns)
        if not fault and self._enabled_since_ns is not None and not self._feedback.obeys():
            fault = "The chassis fell back to standby."
        if not fault and self.state is GuardState.ARMED and now_ns > self._expires_ns:
            fault = f"The navigator's last good command is too old. {self.reason}".rstrip()
        return self._latch(fault, now_ns) if fault else ()

    def _begin_arming(self, now_ns: int) -> Frames:
        if self.state is not GuardState.SILENT or self._arming_since_ns is not None:
            return ()
        fault = self._feedback.fault(now_ns) or ("" if self._feedback.stands(now_ns) else "The robot still moves.")
        if fault:
            self.reason = f"Not armed: {fault}"
            return ()
        self._arming_since_ns, self._zeros_since_ns, self.reason = now_ns, None, "Arming."
        return (ENABLE,)

    def _continue_arming(self, since_ns: int, now_ns: int) -> Frames:
        """Wait for CAN mode, send zeros for a while, then be ARMED."""
        if self._enabled_since_ns is None:
            heard_ns = self._feedback.system_ns or 0
            if self._feedback.obeys() and heard_ns > since_ns:
                self._enabled_since_ns = now_ns
            elif now_ns - since_ns > self.params.enable_ms * MS:
                self._leave(GuardState.SILENT, "Not armed: the chassis did not enter CAN mode.")
            return ()
        if now_ns - self._enabled_since_ns >= self.params.zeros_ms * MS:
            self._arm(now_ns)
        return (ZERO,)

    def _arm(self, now_ns: int) -> None:
        self.state, self.reason, self._arming_since_ns = GuardState.ARMED, "", None
        self._armed_since_ns = self._sent_ns = now_ns
        self._sent, self._accepted_seq = (0.0, 0.0), -1
        self._arrivals.clear()
        self._expires_ns = now_ns + self.params.first_command_ms * MS

    def _disarm(self, now_ns: int) -> Frames:
        if self.state is not GuardState.ARMED and self._arming_since_ns is None:
            return ()
        self._leave(GuardState.SILENT, READY)
        return self._start_zeros(now_ns)

    def _leave(self, state: GuardState, reason: str) -> None:
        self.state, self.reason = state, reason
        self._arming_since_ns = self._enabled_since_ns = None

    def _latch(self, reason: str, now_ns: int) -> Frames:
        if self.state is GuardState.LATCHED:
            return ()
        self._leave(GuardState.LATCHED, reason)
        return self._start_zeros(now_ns)

    def _start_zeros(self, now_ns: int) -> Frames:
        self._zeros_since_ns, self._still_since_ns = now_ns, None
        return self._zero_until_still(now_ns)

    def _zero_until_still(self, now_ns: int) -> Frames:
        """A frame may be lost on the wire: zeros go on until standstill has been reported for a while.

        Only in CAN mode, so that whoever has taken over is not disturbed.
        """
        if self._zeros_since_ns is None:
            return ()
        if not self._feedback.stands(now_ns):
            self._still_since_ns = None
        elif self._still_since_ns is None:
            self._still_since_ns = now_ns
        rested = self._still_since_ns is not None and now_ns - self._still_since_ns >= self.params.zeros_ms * MS
        if rested or now_ns - self._zeros_since_ns >= self.params.longest_zeros_ms * MS:
            self._zeros_since_ns = None
        return (ZERO,) if self._feedback.obeys() else ()
