"""When the 3D map is no ground to drive on, and when it is not believed."""

from __future__ import annotations

from navcore.messages import NavMode
from navcore.mission.event_facts import EventFacts, EventParams


def is_map_unsure(f: EventFacts, p: EventParams) -> bool:
    """The map is driven on and does not tell the place well enough, or not any more."""
    known = f.map_age_s is not None and 0.0 <= f.map_age_s <= p.map_hold_s
    sure = f.pose_std is not None and f.pose_std <= p.map_std
    return f.mode is NavMode.MAP and (bool(f.map_reason) or not known or not sure)


def unsure_words(f: EventFacts) -> str:
    """For the operator."""
    why = f.map_reason or "nothing fits well enough"
    return f"The 3D map does not tell the place: {why}. The robot waits and goes on by itself."


def is_map_disputed(f: EventFacts) -> bool:
    """Clouds fit the map, but in a place that others contradict; something else is driven on."""
    return f.map_disputed and f.mode is not NavMode.MAP


def disputed_words(f: EventFacts) -> str:
    """For the operator."""
    return f"The 3D map is not believed: {f.map_reason}. The robot drives without it."
