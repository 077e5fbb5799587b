"""What the operator sees: the events that are on, and the navigator's state in one message."""

from __future__ import annotations

from navcore.messages import ActiveEvent
from navcore.mission.events import Event, EventFacts
from navcore.mission.state_machine import Effect


class ActiveEvents:
    """The events that are on, each with the moment it came."""

    def __init__(self) -> None:
        self.on: tuple[ActiveEvent, ...] = ()
        self.effects: frozenset[Effect] = frozenset()

    def update(self, now_ns: int, events: tuple[Event, ...], facts: EventFacts) -> None:
        """Take this tick's events; one that was on already keeps its moment."""
        since = {event.name: event.since_ns for event in self.on}
        self.on = tuple(
            ActiveEvent(
                name=event.name,
                effect=", ".join(sorted(event.effects)),
                text=event.text(facts),
                since_ns=since.get(event.name, now_ns),
            )
            for event in events
        )
        self.effects = frozenset(effect for event in events for effect in event.effects)
