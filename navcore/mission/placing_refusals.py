"""Why an operator may not say now where the robot stands."""

from __future__ import annotations

import math

from navcore.messages import FixQuality, MatchState, ToldPlace
from navcore.mission.evidence import NS
from navcore.mission.map_evidence import FRESH_S
from navcore.mission.senses import Senses


def placing_refusals(
    senses: Senses, now_ns: int, place: ToldPlace | None, datum: tuple[float, float, float]
) -> tuple[str, ...]:
    """Every reason, in sentences; empty if the place is taken. What the mission's state forbids is not asked here."""
    if place is None or not all(map(math.isfinite, (place.x, place.y, place.yaw))):
        return ("The place is not a place on the map. Press on the map where the robot stands.",)
    reasons = (_other_farm(place, datum), _no_map(senses, now_ns), _moves(senses), _rtk_knows(senses, now_ns))
    return tuple(reason for reason in reasons if reason)


def _other_farm(place: ToldPlace, datum: tuple[float, float, float]) -> str:
    return "" if place.datum == datum else "This place is on another farm's map. Choose the robot's farm first."


def _no_map(senses: Senses, now_ns: int) -> str:
    told = senses.on_map.told
    if told is None or (now_ns - told.stamp_ns) * NS > FRESH_S:
        return "No 3D LiDAR reports, so nothing could find the robot there. Check its power and its cable."
    return f"There is no 3D map to find the robot on: {told.reason}." if told.state is MatchState.NO_MAP else ""


def _moves(senses: Senses) -> str:
    return "" if senses.standing else "The robot moves. Let it stand still before you say where it stands."


def _rtk_knows(senses: Senses, now_ns: int) -> str:
    age_s = senses.gnss.age_s(now_ns)
    fixed = senses.gnss_quality is FixQuality.RTK_FIXED and age_s is not None and age_s <= FRESH_S
    known = fixed and senses.pose_std is not None
    return "RTK knows where the robot stands. There is no need to say it." if known else ""
