"""What the operator sees: the events that are on, and the navigator's state in one message."""

from __future__ import annotations

from navcore.geometry.angles import wrap
from navcore.messages import ActiveEvent, NavStatus
from navcore.mission.driven_pose import driven_pose
from navcore.mission.events.event import Event
from navcore.mission.events.facts import EventFacts
from navcore.mission.ghosts import ghosts
from navcore.mission.situation import Situation
from navcore.mission.state_machine import Effect


class ActiveEvents:
    """The events that are on, each with the moment it came."""

    def __init__(self) -> None:
        self.on: tuple[ActiveEvent, ...] = ()
        self.stop_reason = ""
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

    def remember_stop(self, *, stopped: bool, just_now: bool) -> None:
        """Keep why the mission was stopped for as long as it is; an operator's stop has no event."""
        if not stopped:
            self.stop_reason = ""
        elif just_now:
            texts = [event.text for event in self.on if Effect.STOP in event.effect]
            self.stop_reason = " ".join(texts) or "Stopped by an operator."


def nav_status(now: Situation, now_ns: int, events: ActiveEvents) -> NavStatus:
    """The message for the operator."""
    s, pilot, chassis = now.senses, now.pilot, now.senses.chassis
    driven = pilot.route.driven(pilot.place) if pilot else 0.0
    pose = driven_pose(now)
    return NavStatus(
        stamp_ns=now_ns,
        state=now.state,
        mode=now.mode,
        mode_reason=pilot.mode_reason if pilot else "no mission",
        run_id=now.run_id,
        segment=pilot.route.segment_number(pilot.place) if pilot else 0,
        segments=len(pilot.route.plan.segments) if pilot else 0,
        row_id=pilot.segment.row_id if pilot else None,
        progress=driven / pilot.route.length if pilot else 0.0,
        remaining=pilot.route.length - driven if pilot else 0.0,
        lateral_error=pilot.projection.lateral if pilot else None,
        heading_error=wrap(pilot.pose.yaw - pilot.projection.heading) if pilot else None,
        v=s.pose.v if s.pose else 0.0,
        omega=s.pose.omega if s.pose else 0.0,
        speed_limit=now.driving.speed_limit,
        speed_reason=now.driving.speed_reason,
        pose=pose,
        gnss_quality=s.gnss_quality,
        gnss_age_s=s.gnss.age_s(now_ns),
        row_age_s=pilot.row.age_s(now_ns) if pilot else None,
        battery_v=chassis.voltage_v if chassis else None,
        guard=chassis.guard.name.lower() if chassis else "silent",
        guard_reason=chassis.guard_reason if chassis else "No word from the chassis.",
        events=events.on,
        stop_reason=events.stop_reason,
        gnss_pose=s.pose,
        camera=s.camera.newest,
        camera_roll=s.attitude.mount_roll,
        trunk=pilot.next_trunk() if pilot else None,
        ghosts=ghosts(now, now_ns, pose),
    )
