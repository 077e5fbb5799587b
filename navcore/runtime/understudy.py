"""Keeps a younger navigator ready, so that a run's log need not begin with everything since the power came on.

A replay is exact only if it begins with a new navigator and all that it ever consumed. While the robot rests,
younger navigators therefore consume the same inputs beside the one in charge. At a start the one that is ready takes
over, and its short history goes into the log as the run's prelude.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from navcore.messages import Decision, NavInputs, Request, RequestKind, RunState
from navcore.navigator import Navigator

RESTING = frozenset({RunState.IDLE, RunState.FINISHED, RunState.STOPPED})


@dataclass(frozen=True, slots=True, kw_only=True)
class UnderstudyParams:
    """Attributes:
    generation_s: age at which a younger navigator is ready, s, > 5: it must have found its pose.
    longest_history_s: of inputs that are kept; a run that began with older ones cannot be replayed, s.
    """

    generation_s: float = 20.0
    longest_history_s: float = 300.0


class Rehearsed:
    """A navigator and all that it consumed, None once that was too much."""

    def __init__(self, navigator: Navigator, now_ns: int) -> None:
        self.navigator = navigator
        self.born_ns = now_ns
        self.history: list[bytes] | None = []
        self.has_pose = False

    def step(self, now_ns: int, inputs: NavInputs, encoded: bytes) -> Decision:
        """Step, and remember."""
        decision = self.navigator.step(now_ns, inputs)
        self.has_pose = decision.status.pose is not None
        if self.history is not None:
            self.history.append(encoded)
        return decision


@dataclass(frozen=True, slots=True)
class Taken:
    """A tick's decision, and at a start the encoded inputs that the navigator in charge had consumed before it."""

    decision: Decision
    prelude: tuple[bytes, ...] | None = None
    prelude_complete: bool = False


class Understudy:
    """Steps the navigator in charge, and beside it those that may take over."""

    def __init__(
        self, new_navigator: Callable[[], Navigator], now_ns: int, params: UnderstudyParams | None = None
    ) -> None:
        self._new = new_navigator
        self._params = params or UnderstudyParams()
        self._leading = Rehearsed(new_navigator(), now_ns)
        self._ready: Rehearsed | None = None
        self._warming: Rehearsed | None = Rehearsed(new_navigator(), now_ns)

    @property
    def leading(self) -> Navigator:
        """The one in charge."""
        return self._leading.navigator

    def step(self, now_ns: int, inputs: NavInputs, encoded: bytes) -> Taken:
        """One tick; `encoded` are the inputs as they go into the log."""
        decision = self._leading.step(now_ns, inputs, encoded)
        younger = [(r, r.step(now_ns, inputs, encoded)) for r in (self._ready, self._warming) if r is not None]
        start = next((r for r in inputs.requests if r.kind is RequestKind.START), None)
        if start is not None and _accepts(decision, start):
            return self._begin(decision, younger, start)
        self._age(now_ns, decision)
        return Taken(decision)

    def _begin(self, decision: Decision, younger: list[tuple[Rehearsed, Decision]], start: Request) -> Taken:
        """The first that would start as well takes over: the longer it has watched the better."""
        for rehearsed, own in younger:
            if rehearsed.has_pose and _accepts(own, start):
                self._leading, decision = rehearsed, own
                break
        history, self._leading.history = self._leading.history, None
        self._ready = self._warming = None
        return Taken(decision, tuple(history[:-1]) if history else (), history is not None)

    def _age(self, now_ns: int, decision: Decision) -> None:
        if decision.status.state not in RESTING:
            self._ready = self._warming = None
            return
        for rehearsed in (self._leading, self._ready):
            if rehearsed is not None and now_ns - rehearsed.born_ns > self._params.longest_history_s * 1e9:
                rehearsed.history = None
        if self._warming is None:
            self._warming = Rehearsed(self._new(), now_ns)
        elif now_ns - self._warming.born_ns > self._params.generation_s * 1e9 and self._warming.has_pose:
            self._ready, self._warming = self._warming, Rehearsed(self._new(), now_ns)


def _accepts(decision: Decision, start: Request) -> bool:
    return any(reply.accepted and reply.request_id == start.request_id for reply in decision.replies)
