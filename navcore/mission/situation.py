"""The mission's situation in one tick, and the facts of it that the event table looks at."""

from __future__ import annotations

from dataclasses import dataclass

from navcore.messages import LinkLossPolicy, NavMode, RunState, SegmentKind
from navcore.mission.driver import Driving
from navcore.mission.events.facts import EventFacts
from navcore.mission.evidence import NS
from navcore.mission.mode_selector import CARRIED
from navcore.mission.pilot import Pilot
from navcore.mission.senses import Senses

# An entrance is near within this distance, m: no room is left to get in line before it.
AT_ENTRANCE = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class Situation:
    """State of the mission, and all who know of it.

    Attributes:
        since_ns: when `state` began. heard_ns: when an operator's page was last heard of.
        driving: what the driver wanted in the last tick.
        body_width: of the robot, m.
    """

    state: RunState
    since_ns: int
    run_id: str | None
    link_loss: LinkLossPolicy
    heard_ns: int
    senses: Senses
    pilot: Pilot | None
    driving: Driving
    body_width: float

    @property
    def moving(self) -> bool:
        """Driving, or holding for a moment."""
        return self.state in (RunState.DRIVING, RunState.HOLDING)

    @property
    def mode(self) -> NavMode:
        """The source driven on."""
        return self.pilot.mode if self.pilot else NavMode.IDLE


def event_facts(
    now: Situation, now_ns: int, *, tick_s: float, stuck: bool, start_distance: float | None = None
) -> EventFacts:
    """All that the event table looks at."""
    s, pilot, since_s = now.senses, now.pilot, (now_ns - now.since_ns) * NS
    cap = s.check.cap(now_ns, on_gnss=now.mode is NavMode.GNSS_PATH)
    return EventFacts(
        state=now.state,
        mode=now.mode,
        tick_s=tick_s,
        chassis=s.chassis,
        chassis_age_s=s.chassis_age_s(now_ns),
        system_age_s=s.system_age_s(now_ns),
        pose_std=s.pose_std,
        carried=pilot.carried if pilot else 0.0,
        gnss_age_s=s.gnss.age_s(now_ns),
        pose_cap=cap.speed,
        pose_cap_reason=cap.reason,
        pose_cap_passes=cap.passes,
        row_age_s=pilot.row.age_s(now_ns) if pilot else None,
        row_reason=pilot.row.reason if pilot else "",
        entrance=_unseen_entrance(now),
        room=_room_at_entrance(now),
        lateral_error=pilot.projection.lateral if pilot else None,
        captured=pilot.captured if pilot else True,
        stuck=stuck,
        held_s=since_s if now.state is RunState.HOLDING else 0.0,
        arming_s=since_s if now.state is RunState.STARTING else 0.0,
        link_age_s=(now_ns - now.heard_ns) * NS,
        link_loss=now.link_loss,
        zone=now.driving.zone,
        start_distance=start_distance,
        waiting_for_gnss=_waits_for_gnss(now),
        askew=s.attitude.mount_roll,
        mount=s.camera.newest,
        agreement=s.camera.agreement,
        halt=pilot.halt if pilot else "",
        map_age_s=s.on_map.age_s(now_ns),
        map_reason=s.on_map.reason,
        map_disputed=s.on_map.disputed,
        map_match=s.on_map.told,
        lidar3d_turned=s.on_map.turned,
        map_in_use=s.on_map.in_use(now_ns),
    )


def _unseen_entrance(now: Situation) -> float | None:
    """Metres to the entrance of a row that the robot drives at without seeing it."""
    pilot = now.pilot
    if pilot is None or pilot.segment.kind is not SegmentKind.ENTRY:
        return None
    unseen = pilot.mode in (NavMode.GNSS_PATH, NavMode.HEADLAND) and not pilot.before_seen_row
    return pilot.to_start() if unseen else None


def _room_at_entrance(now: Situation) -> float | None:
    """Metres between body and plants on the narrower side; None away from an entrance that is driven at on sight."""
    pilot = now.pilot
    if pilot is None or pilot.mode not in (NavMode.ROW_ENTRY, NavMode.HEADLAND) or pilot.row.agreeing is None:
        return None
    ahead, seen = pilot.to_start(), pilot.row.agreeing
    if ahead is None or not 0.0 < ahead <= AT_ENTRANCE or seen.offset is None or seen.width is None:
        return None
    return (seen.width - now.body_width) / 2 - abs(seen.offset)


def _waits_for_gnss(now: Situation) -> bool:
    """The row is left, the road begins, and GNSS is not good enough yet."""
    pilot = now.pilot
    on_road = pilot is not None and pilot.mode in CARRIED and pilot.segment.kind is SegmentKind.ROAD
    return bool(now.moving and pilot and on_road and not pilot.gnss_good)
