"""When the 3D map is no ground to drive on, when it is not believed, and when it waits for an operator's word."""

from __future__ import annotations

from navcore.messages import NavMode, RunState
from navcore.mission.events.facts import EventFacts, EventParams


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


def is_place_unknown(f: EventFacts, p: EventParams) -> bool:
    """No mission is on, a 3D map is in use, and neither it nor GNSS tells the place: a person may."""
    unknown = f.pose_std is None or not f.pose_std <= p.pose_std
    return f.map_in_use and unknown and f.state in (RunState.IDLE, RunState.FINISHED)


def unknown_words(f: EventFacts) -> str:
    """For the operator."""
    return f"The robot does not know where it stands: {f.map_reason or 'GNSS has no fix'}. Say it on the map."
