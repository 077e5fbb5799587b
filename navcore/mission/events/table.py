"""The table of events: when each is on, what it does to the mission, and what the operator should know and do.

The state machine sees effects only. To add a fault, add a line.
"""

from __future__ import annotations

from collections.abc import Callable

from navcore.chassis.protocol import ChassisState, ControlMode, GuardState, VehicleState
from navcore.messages import LinkLossPolicy, NavMode, RunState
from navcore.mission.events import lidar3d
from navcore.mission.events.camera import (
    askew_words,
    is_askew,
    is_pitched,
    is_raised,
    is_turned,
    pitched_words,
    raised_words,
    turned_words,
)
from navcore.mission.events.event import Event, event, warning
from navcore.mission.events.facts import EventFacts, EventParams
from navcore.mission.events.map import (
    disputed_words,
    is_map_disputed,
    is_map_unsure,
    is_place_unknown,
    unknown_words,
    unsure_words,
)
from navcore.mission.state_machine import MOVING, UNDER_WAY


def _old(age: float | None, limit: float) -> bool:
    """True unless the age is known and within the limit: a NaN is old."""
    return age is None or not (0.0 <= age <= limit)


def _on_gnss(f: EventFacts) -> bool:
    return f.mode is NavMode.GNSS_PATH


def _by_row(f: EventFacts) -> bool:
    """In the middle of a mission, where the row or odometry tells where the robot is and GNSS does not."""
    amid = f.state in UNDER_WAY or f.state is RunState.STOPPED
    return amid and f.mode not in (NavMode.GNSS_PATH, NavMode.IDLE)


def _capped_to_nothing(f: EventFacts) -> bool:
    return f.pose_cap is not None and not f.pose_cap > 0.0


def _moving(f: EventFacts) -> bool:
    return f.state in (RunState.DRIVING, RunState.HOLDING)


def _chassis(f: EventFacts, test: Callable[[ChassisState], bool]) -> bool:
    return f.chassis is not None and test(f.chassis)


def _told(f: EventFacts) -> str:
    """Why the guard holds the chassis, in its own words."""
    return f.chassis.guard_reason.rstrip(".") if f.chassis else "it is silent"


def _drivers_failed(c: ChassisState) -> bool:
    return any(state & 0b1111 for state in c.driver_faults)


EVENTS: tuple[Event, ...] = (
    event(
        "chassis_silent", "NO_ENTRY STOP",
        lambda f, p: _old(f.chassis_age_s, p.chassis_s) or _old(f.system_age_s, p.system_s),
        "The chassis does not report. Check its power and the CAN cable.",
    ),
    event(
        "emergency_stop", "NO_ENTRY STOP",
        lambda f, _: _chassis(f, lambda c: c.state is VehicleState.EMERGENCY_STOP),
        "The emergency stop is pressed. Release it, then acknowledge.",
    ),
    event(
        "chassis_fault", "NO_ENTRY STOP",
        lambda f, _: _chassis(f, lambda c: c.state is VehicleState.EXCEPTION or _drivers_failed(c)),
        lambda f: f"The chassis reports a fault (0x{f.chassis.faults:02x}). Look at the drives before going on."
        if f.chassis else "",
    ),
    event(
        "remote_control", "NO_ENTRY STOP",
        lambda f, _: _chassis(f, lambda c: c.mode is ControlMode.REMOTE),
        "The remote control has taken over. Give control back on the remote, then start again.",
    ),
    event(
        "chassis_left_can", "STOP",
        lambda f, _: _moving(f) and _chassis(f, lambda c: c.mode is not ControlMode.CAN),
        "The chassis no longer obeys. Check it, then resume.",
    ),
    event(
        "guard_latched", "STOP",
        lambda f, _: _moving(f) and _chassis(f, lambda c: c.guard is not GuardState.ARMED),
        lambda f: f"The guard has stopped the robot: {_told(f)}.",
    ),
    event(
        "not_arming", "STOP",
        lambda f, p: f.state is RunState.STARTING and f.arming_s > p.arming_s,
        lambda f: f"The chassis did not accept control: {_told(f)}.",
    ),
    event(
        "battery_empty", "NO_ENTRY STOP",
        lambda f, p: _chassis(f, lambda c: not c.voltage_v >= p.battery_stop_v),
        "The battery is empty. Charge it.",
    ),
    event(
        "battery_low", "NO_ENTRY SLOW",
        lambda f, p: _chassis(f, lambda c: not c.voltage_v >= p.battery_low_v),
        "The battery is low. Bring the robot back and charge it.",
    ),
    event(
        "tick_late", "STOP",
        lambda f, p: f.state in MOVING and not f.tick_s <= p.tick_stop_s,
        lambda f: f"The computer was busy for {f.tick_s * 1e3:.0f} ms. Close other programs, then resume.",
    ),
    event(
        "tick_slow", "WARN",
        lambda f, p: f.state in MOVING and p.tick_slow_s < f.tick_s <= p.tick_stop_s,
        lambda f: f"The computer was busy for {f.tick_s * 1e3:.0f} ms. Close other programs if this comes again.",
    ),
    event(
        "no_position", "NO_ENTRY",
        lambda f, _: f.pose_std is None,
        "Position and heading are not known yet. Wait for the GNSS fix; the robot needs open sky.",
    ),
    event(
        "position_unsure", "NO_ENTRY",
        lambda f, p: f.pose_std is not None and not f.pose_std <= p.pose_std and not _by_row(f),
        lambda f: f"The position is only known to {f.pose_std or 0:.1f} m. Wait for an RTK fix.",
    ),
    event(
        "gnss_old", "SLOW",
        lambda f, p: f.state in UNDER_WAY and _on_gnss(f) and _old(f.gnss_age_s, p.gnss_slow_s),
        "GNSS has gone quiet. The robot drives slowly on odometry and will stop soon.",
    ),
    event(
        "gnss_lost", "STOP",
        lambda f, p: f.state in MOVING and _on_gnss(f)
        and (_old(f.gnss_age_s, p.gnss_stop_s) or f.pose_std is None or not f.pose_std <= p.pose_std),
        "GNSS is lost. Check antenna and corrections, wait for the fix, then resume.",
    ),
    event(
        "pose_in_doubt", "STOP",
        lambda f, _: f.state in MOVING and _capped_to_nothing(f) and not f.pose_cap_passes,
        lambda f: f"The position is in doubt: {f.pose_cap_reason}. Look at the robot and the antenna, then resume.",
    ),
    event(
        "pose_apart", "HOLD", lambda f, _: _moving(f) and _capped_to_nothing(f) and f.pose_cap_passes,
        lambda f: f"GNSS has no fix: {f.pose_cap_reason}. The robot waits and goes on by itself.",
    ),
    event(
        "pose_weak", "SLOW",
        lambda f, _: f.state in UNDER_WAY and f.pose_cap is not None and f.pose_cap > 0.0,
        lambda f: f"The robot drives slowly: {f.pose_cap_reason}.",
    ),
    event(
        "waiting_for_gnss", "HOLD",
        lambda f, _: f.waiting_for_gnss,
        "The row is left and GNSS has no fix yet. The robot waits and goes on by itself.",
    ),
    event(
        "entrance_unseen", "HOLD",
        lambda f, p: _moving(f) and f.entrance is not None and not f.entrance > p.entrance,
        lambda f: f"The row's entrance is near and the camera does not see the row: {f.row_reason or 'no picture'}. "
        "The robot waits and goes on by itself.",
    ),
    event(
        "beside_entrance", "STOP",
        lambda f, p: f.state in MOVING and f.room is not None and not f.room >= p.room,
        "The robot is not in line with the row's entrance. Drive it back some metres by hand, then resume.",
    ),
    event(
        "row_unseen", "HOLD",
        lambda f, p: _moving(f) and f.mode in (NavMode.ROW_ENTRY, NavMode.ROW) and _old(f.row_age_s, p.row_hold_s),
        lambda f: f"The camera sees no row: {f.row_reason or 'no picture'}. The robot waits and goes on by itself.",
    ),
    event(
        "camera_askew", "WARN",
        lambda f, p: f.state in UNDER_WAY and is_askew(f, p),
        askew_words,
    ),
    event("camera_pitched", "WARN", lambda f, p: f.state in UNDER_WAY and is_pitched(f, p), pitched_words),
    event("camera_turned", "WARN", lambda f, _: f.state in UNDER_WAY and is_turned(f), turned_words),
    event("camera_raised", "WARN", lambda f, p: f.state in UNDER_WAY and is_raised(f, p), raised_words),
    event(
        "carried_too_far", "HOLD",
        lambda f, p: _moving(f) and f.mode in (NavMode.ROW_END, NavMode.HEADLAND) and not f.carried <= p.carried,
        "The robot has driven on odometry for as long as it may, and waits for GNSS or a row.",
    ),
    event("map_unsure", "HOLD", lambda f, p: _moving(f) and is_map_unsure(f, p), unsure_words),
    warning("lidar3d_empty", lidar3d.is_empty, lidar3d.empty_words),
    warning("lidar3d_leans", lidar3d.is_leaning, lidar3d.leaning_words),
    warning("lidar3d_turned", lidar3d.is_aside, lidar3d.aside_words),
    warning("lidar3d_drops", lidar3d.is_raining, lidar3d.raining_words),
    warning("map_outdated", lidar3d.is_outdated, lidar3d.outdated_words),
    event("map_disputed", "WARN", lambda f, _: f.state in UNDER_WAY and is_map_disputed(f), disputed_words),
    event("place_unknown", "WARN", is_place_unknown, unknown_words),
    event(
        "held_too_long", "STOP",
        lambda f, p: f.state is RunState.HOLDING
        and f.held_s > (p.gnss_hold_s if f.waiting_for_gnss or f.pose_cap_passes else p.hold_stop_s),
        "The robot has waited too long. Look at what it waits for, then resume.",
    ),
    event(
        "off_path", "SLOW",
        lambda f, p: _moving(f) and f.lateral_error is not None and not abs(f.lateral_error) <= p.off_path_slow,
        lambda f: f"The robot is {abs(f.lateral_error or 0) * 100:.0f} cm off its path and drives slowly.",
    ),
    event(
        "far_off_path", "STOP",
        lambda f, p: _moving(f) and f.lateral_error is not None
        and not abs(f.lateral_error) <= (p.off_path_stop if f.captured else p.start_distance),
        lambda f: f"The robot is {abs(f.lateral_error or 0) * 100:.0f} cm off its path. Move it back, then resume.",
    ),
    event(
        "no_progress", "STOP",
        lambda f, _: f.stuck,
        "The robot does not get on. Look what blocks it, then resume.",
    ),
    event("zone", "STOP", lambda f, _: _moving(f) and bool(f.zone), lambda f: f.zone),
    event(
        "link_lost", "STOP",
        lambda f, p: f.state in MOVING and f.link_loss is LinkLossPolicy.STOP and not f.link_age_s <= p.link_s,
        "No operator's page was heard of. Open the page, then resume.",
    ),
    event("halt", "WARN", lambda f, _: f.state in UNDER_WAY and bool(f.halt), lambda f: f.halt),
    event(
        "not_at_start", "NO_ENTRY",
        lambda f, p: f.start_distance is not None and not f.start_distance <= p.start_distance,
        lambda f: f"The robot is {f.start_distance or 0:.1f} m from the mission's start. Bring it there first.",
    ),
)  # fmt: skip


def active_events(facts: EventFacts, params: EventParams) -> tuple[Event, ...]:
    """All events that are on, in the order of the table."""
    return tuple(event for event in EVENTS if event.when(facts, params))
