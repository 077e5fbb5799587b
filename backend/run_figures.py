"""Summary figures of a run, from the navigator's own status messages. Pure: no clock, no database."""

from __future__ import annotations

from dataclasses import dataclass, field
from datetime import datetime

from backend.schemas import RunDocument, RunEventDocument, RunOutcome
from navcore.messages import ModeSwitch, NavStatus, RunState

LONGEST_STEP_S = 1.0  # a longer gap between two statuses is a gap in what we saw, not driving time
# The way from where the robot was parked to its line is no driving on it.
REACHED_M = 0.3
ENDS = {RunState.FINISHED: RunOutcome.FINISHED, RunState.STOPPED: RunOutcome.STOPPED}
MOVING = frozenset({RunState.STARTING, RunState.DRIVING, RunState.HOLDING, RunState.PAUSED})


@dataclass(slots=True)
class RunFigures:
    """Sums over the statuses of one run, oldest first.

    Attributes:
        run_id: the run; statuses of others must not be added.
        started_ns: monotonic time of its first status.
        distance_m: integral of |v| over the statuses.
        abs_error_m: integral of |lateral error| over the driven distance, m^2.
        max_error: m, None until it has been on its line; errors count from there.
        stop_reason: why it was stopped, kept after the stop is acknowledged; empty once it drives on.
        ended: when that was first written; None while it goes on.
    """

    run_id: str
    started_ns: int | None = None
    last: NavStatus | None = None
    duration_s: float = 0.0
    distance_m: float = 0.0
    abs_error_m: float = 0.0
    error_distance_m: float = 0.0
    max_error: float | None = None
    switches: int = 0
    holds: int = 0
    outcome: RunOutcome = RunOutcome.STARTING
    stop_reason: str = ""
    ended: datetime | None = None
    fresh_events: list[RunEventDocument] = field(default_factory=list)

    def add(self, status: NavStatus) -> None:
        """Take in the next status."""
        if self.started_ns is None:
            self.started_ns = status.stamp_ns - round(self.duration_s * 1e9)
        before, self.last = self.last, status
        if before is not None:
            self._integrate(before, status)
        if status.stop_reason or status.state in MOVING:
            self.stop_reason = status.stop_reason
        self._note_changes(before, status)

    def add_switch(self, switch: ModeSwitch) -> None:
        """Take in a change of mode."""
        self.switches += 1
        self._note(switch.stamp_ns, "mode", f"{switch.before} -> {switch.after}: {switch.reason}")

    def _integrate(self, before: NavStatus, status: NavStatus) -> None:
        step_s = (status.stamp_ns - before.stamp_ns) / 1e9
        if not 0.0 < step_s <= LONGEST_STEP_S or status.state not in MOVING:
            return
        self.duration_s += step_s
        step_m = abs(status.v) * step_s
        self.distance_m += step_m
        if status.lateral_error is not None and status.state is RunState.DRIVING:
            self._add_error(abs(status.lateral_error), step_m)

    def _add_error(self, off: float, step_m: float) -> None:
        if self.max_error is None and off > REACHED_M:
            return
        self.abs_error_m += off * step_m
        self.error_distance_m += step_m
        self.max_error = max(self.max_error or 0.0, off)

    def _note_changes(self, before: NavStatus | None, status: NavStatus) -> None:
        known = {event.name for event in before.events} if before else set()
        for event in status.events:
            if event.name not in known:
                self._note(status.stamp_ns, event.effect, event.text)
        if before is not None and before.state is status.state:
            return
        self.holds += status.state is RunState.HOLDING
        if status.state in ENDS:
            self.outcome = ENDS[status.state]
        elif status.state in MOVING:
            self.outcome = RunOutcome.RUNNING
        self._note(status.stamp_ns, "state", status.state.value)

    def _note(self, stamp_ns: int, kind: str, text: str) -> None:
        t_s = (stamp_ns - (self.started_ns or stamp_ns)) / 1e9
        self.fresh_events.append(RunEventDocument(t_s=t_s, kind=kind, text=text))

    @property
    def mean_error(self) -> float | None:
        """Mean |lateral error| over the driven distance, m."""
        return self.abs_error_m / self.error_distance_m if self.error_distance_m > 0.0 else None

    @property
    def over(self) -> bool:
        """Whether the run has come to an end, for now: a stopped run may be resumed."""
        return self.outcome in ENDS.values()

    def columns(self, now: datetime) -> dict[str, object]:
        """For the run's row, written `now`."""
        self.ended = (self.ended or now) if self.over else None
        return {
            "ended": self.ended,
            "outcome": self.outcome.value,
            "state": self.last.state.value if self.last else None,
            "reason": self._reason(),
            "duration_s": self.duration_s,
            "distance_m": self.distance_m,
            "progress": self.last.progress if self.last else 0.0,
            "mean_lateral_error": self.mean_error,
            "max_lateral_error": self.max_error,
            "mode_switches": self.switches,
            "holds": self.holds,
        }

    def _reason(self) -> str:
        """Why it stands: what stopped it, else the texts of what is on now."""
        events = self.last.events if self.last else ()
        return self.stop_reason or " ".join(event.text for event in events)


def resumed(run: RunDocument) -> RunFigures:
    """The sums of a run whose beginning was seen before the station was restarted."""
    return RunFigures(
        run_id=run.id,
        duration_s=run.duration_s,
        distance_m=run.distance_m,
        abs_error_m=(run.mean_lateral_error or 0.0) * run.distance_m,
        error_distance_m=run.distance_m if run.mean_lateral_error is not None else 0.0,
        max_error=run.max_lateral_error,
        switches=run.mode_switches,
        holds=run.holds,
        outcome=run.outcome,
        ended=run.ended,
        stop_reason=run.reason if run.outcome is RunOutcome.STOPPED else "",
    )
