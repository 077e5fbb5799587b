"""Inputs and beliefs of the last seconds, so that a late measurement enters at its time of capture.

All that came is kept in the order of capture. A late event is put in its place and everything after it is run again
from the belief before it. The result is the same as if it had come in time, bit for bit.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Callable
from dataclasses import dataclass, field

from navcore.localization.belief import Belief
from navcore.localization.verdict import Verdict

Apply = Callable[[Belief], list[Verdict]]


@dataclass(slots=True)
class Event:
    """Something that changes a belief which stands at `stamp_ns`.

    Attributes:
        apply: changes it in place.
        hold: only takes over the input values, for events before the filter's start; None for measurements.
        after: belief behind this event.
    """

    stamp_ns: int
    apply: Apply
    hold: Apply | None = None
    after: Belief | None = field(default=None, compare=False)


class BeliefHistory:
    """Sorted events and the belief behind each.

    Args:
        length_ns: how late a measurement may be.
        propagate: carries a belief in place to a time.
    """

    def __init__(self, length_ns: int, propagate: Callable[[Belief, int], None]) -> None:
        self._length_ns = length_ns
        self._propagate = propagate
        self._events: list[Event] = []
        self._base: Belief | None = None
        self._asked: tuple[Belief, Belief] | None = None

    @property
    def newest(self) -> Belief | None:
        """Belief behind the newest event; not to be changed."""
        return self._events[-1].after if self._events and self._base is not None else self._base

    @property
    def newest_ns(self) -> int | None:
        """Time of the newest event."""
        return self._events[-1].stamp_ns if self._events else None

    @property
    def oldest_ns(self) -> int:
        """Nothing can enter before this."""
        if self._base is not None:
            return self._base.stamp_ns
        return 0 if not self._events else self._events[-1].stamp_ns - self._length_ns

    def start(self, belief: Belief) -> None:
        """First belief; what came since its time is run again, what came before only gives the held inputs."""
        at = self._place(belief.stamp_ns)
        for event in self._events[:at]:
            if event.hold is not None:
                event.hold(belief)
        del self._events[:at]
        self._base = belief
        self._run_from(0)

    def stop(self) -> None:
        """Forget the belief, keep the inputs."""
        self._base = None
        self._events = [e for e in self._events if e.hold is not None]

    def add(self, event: Event) -> list[Verdict]:
        """Put an event in its place; what it said itself. `event` is not older than `oldest_ns`."""
        at = self._place(event.stamp_ns)
        self._events.insert(at, event)
        verdicts = self._run_from(at)
        self._prune()
        return verdicts

    def at(self, stamp_ns: int) -> Belief | None:
        """Belief at a time, predicted from the last event before it; None before the first belief. Not to be changed:
        whoever asks again for the same time is given the same.
        """
        if self._base is None or stamp_ns < self._base.stamp_ns:
            return None
        index = self._place(stamp_ns)
        before = self._events[index - 1].after if index else self._base
        assert before is not None
        if self._asked is not None and self._asked[0] is before and self._asked[1].stamp_ns == stamp_ns:
            return self._asked[1]
        belief = before.copy()
        self._propagate(belief, stamp_ns)
        self._asked = before, belief
        return belief

    def _run_from(self, index: int) -> list[Verdict]:
        """Verdicts of the event at `index`; the ones after it spoke when they came."""
        if self._base is None:
            return []
        before = self._events[index - 1].after if index else self._base
        first: list[Verdict] = []
        for i, event in enumerate(self._events[index:]):
            assert before is not None
            belief = before.copy()
            self._propagate(belief, event.stamp_ns)
            verdicts = event.apply(belief)
            event.after = before = belief
            first = verdicts if i == 0 else first
        return first

    def _place(self, stamp_ns: int) -> int:
        """Behind all events up to that time; nearly always at the end."""
        if not self._events or self._events[-1].stamp_ns <= stamp_ns:
            return len(self._events)
        return bisect_right(self._events, stamp_ns, key=lambda e: e.stamp_ns)

    def _prune(self) -> None:
        """In portions, as a list gives up its front slowly."""
        limit = self._events[-1].stamp_ns - self._length_ns
        if self._events[0].stamp_ns > limit - self._length_ns // 8:
            return
        drop = self._place(limit) - 1
        if drop <= 0:
            return
        if self._base is not None:
            self._base = self._events[drop - 1].after
        del self._events[:drop]
