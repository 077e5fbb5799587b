"""One line of the table of events."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from navcore.mission.events.facts import EventFacts, EventParams
from navcore.mission.state_machine import UNDER_WAY, Effect


@dataclass(frozen=True, slots=True)
class Event:
    """One line of the table."""

    name: str
    effects: frozenset[Effect]
    when: Callable[[EventFacts, EventParams], bool]
    text: Callable[[EventFacts], str]


def event(
    name: str, effects: str, when: Callable[[EventFacts, EventParams], bool], text: str | Callable[[EventFacts], str]
) -> Event:
    """A line; `effects` as words with blanks between."""
    words = frozenset(Effect(word) for word in effects.split())
    return Event(name, words, when, text if callable(text) else _fixed(text))


def warning(
    name: str, when: Callable[[EventFacts, EventParams], bool], words: Callable[[EventFacts], str]
) -> Event:  # fmt: skip
    """One that is told while a mission is under way."""
    return event(name, "WARN", lambda f, p: f.state in UNDER_WAY and when(f, p), words)


def effects_of(events: tuple[Event, ...]) -> frozenset[Effect]:
    """All effects of some events."""
    return frozenset(effect for event in events for effect in event.effects)


def _fixed(text: str) -> Callable[[EventFacts], str]:
    return lambda _: text
