"""What is known on the way, as the choice of the source to drive on looks at it."""

from __future__ import annotations

from navcore.mission.evidence import RowEvidence
from navcore.mission.map_evidence import MapEvidence
from navcore.mission.mode_facts import ModeFacts
from navcore.mission.position import Position
from navcore.mission.route import Leg, row_length


def mode_facts(
    at: Position, leg: Leg, s: float, row: RowEvidence, on_map: MapEvidence, look_out: float, to_start: float | None
) -> ModeFacts:
    """Facts of one tick at arc length `s` of a leg; `to_start` as in `ModeFacts`."""
    segment, seen = leg.row_segment(s, look_out), row.agreeing
    return ModeFacts(
        segment=leg.segment(s).kind,
        to_start=to_start,
        to_end=row_length(segment) + to_start if segment is not None and to_start is not None else None,
        row_follows=leg.row_follows(s),
        turn_follows=leg.turn_follows(s),
        row_streak=row.streak,
        row_age_s=row.age_s(at.now_ns),
        looks=row.looks(at.now_ns),
        seen_end=seen.end_distance if seen else None,
        seen_to=seen.seen_to if seen else None,
        gnss_std=at.gnss_std,
        gnss_streak=at.gnss_streak,
        map_streak=on_map.streak,
        map_age_s=on_map.age_s(at.now_ns),
        map_leads=on_map.leads_through(leg.row_way(s, look_out)),
    )
