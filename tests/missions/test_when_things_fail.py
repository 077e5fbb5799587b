"""Whatever fails under way, the robot stops or waits, says why, and moves again only when it may."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

from navcore.chassis.protocol import GuardState, VehicleState
from navcore.maps.mission import RowExit
from navcore.maps.site_map import SiteMap
from navcore.messages import FixQuality, NavMode, RequestKind, RunState
from navcore.planning.mission_planner import mission_for_row
from navcore.runtime.lockstep import Tick
from navcore.sim.world import WorldParams
from tests.missions.conftest import Drive, new_drive

Park = Callable[[int], Drive]


def on_the_road(park: Park, farm: SiteMap) -> Drive:
    """A robot at speed on the way to its row."""
    drive = park(7)
    drive.start(farm, mission_for_row(farm, "r1", RowExit.REVERSE))
    tick = drive.until(lambda tick: tick.truth.v > 0.5, seconds=60)
    assert tick.truth.v > 0.5  # m/s
    return drive


def in_the_row(park: Park, farm: SiteMap) -> Drive:
    """A robot some metres inside its row."""
    drive = on_the_road(park, farm)
    drive.until_mode(NavMode.ROW)
    drive.until(lambda _: False, seconds=5)
    return drive


def events(tick: Tick) -> set[str]:
    return {event.name for event in tick.decision.status.events}


def stands(tick: Tick) -> bool:
    return abs(tick.truth.v) < 0.01


def seconds_until(drive: Drive, condition: Callable[[Tick], bool], limit: float) -> float:
    """Simulated time until something holds; fails after the limit."""
    before = drive.lockstep.now_ns
    tick = drive.until(condition, limit)
    assert condition(tick), tick.decision.status
    return (drive.lockstep.now_ns - before) * 1e-9


def test_operator_stop_stands_within_a_second_and_stays(park: Park, farm: SiteMap) -> None:
    drive = on_the_road(park, farm)
    drive.ask(RequestKind.STOP)
    assert seconds_until(drive, stands, limit=2.0) < 1.5  # s, from 0.8 m/s
    tick = drive.until(lambda tick: not stands(tick), seconds=10)
    assert stands(tick)
    assert tick.decision.status.state is RunState.STOPPED
    assert tick.decision.status.stop_reason == "Stopped by an operator."


def test_a_stopped_mission_is_resumed_only_by_a_deliberate_request(park: Park, farm: SiteMap) -> None:
    drive = on_the_road(park, farm)
    drive.ask(RequestKind.STOP)
    drive.until(lambda _: False, seconds=3)
    drive.ask(RequestKind.RESUME)
    tick = drive.until(lambda tick: tick.truth.v > 0.3, seconds=10)
    assert tick.truth.v > 0.3  # m/s


def test_a_robot_stopped_in_a_row_where_gnss_knows_nothing_can_go_on(farm: SiteMap) -> None:
    params = WorldParams(seed=4)
    drive = new_drive(farm, replace(params, gnss=replace(params.gnss, outages_s=((75.0, 400.0),))))
    drive.start(farm, mission_for_row(farm, "r1", RowExit.REVERSE))
    drive.until_mode(NavMode.ROW)
    vague = drive.until(lambda tick: gnss_std(tick) > 0.64, seconds=120)
    assert gnss_std(vague) > 0.64  # m
    assert vague.decision.status.mode is NavMode.ROW
    drive.ask(RequestKind.STOP)
    drive.until(lambda _: False, seconds=3)
    drive.ask(RequestKind.RESUME)
    tick = drive.until(lambda tick: abs(tick.truth.v) > 0.2, seconds=10)
    assert abs(tick.truth.v) > 0.2  # m/s


def gnss_std(tick: Tick) -> float:
    """Of the position by GNSS and wheels, along its worse axis, m."""
    pose = tick.decision.status.gnss_pose
    return 0.0 if pose is None else math.sqrt(max(pose.covariance[0], pose.covariance[4]))


def test_pause_holds_and_resume_goes_on(park: Park, farm: SiteMap) -> None:
    drive = on_the_road(park, farm)
    drive.ask(RequestKind.PAUSE)
    tick = drive.until(stands, seconds=5)
    assert tick.decision.status.state is RunState.PAUSED
    drive.ask(RequestKind.RESUME)
    assert drive.until(lambda tick: tick.truth.v > 0.3, seconds=10).truth.v > 0.3  # m/s


def test_emergency_stop_stops_and_its_release_does_not_move_the_robot(park: Park, farm: SiteMap) -> None:
    drive = on_the_road(park, farm)
    drive.lockstep.ecu.state = VehicleState.EMERGENCY_STOP
    seconds_until(drive, stands, limit=1.5)
    drive.lockstep.ecu.state = VehicleState.NORMAL
    tick = drive.until(lambda tick: not stands(tick), seconds=10)
    assert stands(tick)
    assert tick.decision.status.state is RunState.STOPPED


def test_silent_gnss_slows_then_stops_on_the_road(park: Park, farm: SiteMap) -> None:
    drive = on_the_road(park, farm)
    drive.lockstep.world.faults = replace(drive.lockstep.world.faults, gnss_silent=True)
    assert seconds_until(drive, lambda t: "gnss_old" in events(t), limit=2.0) <= 1.6  # s: age 1.0 and latency
    seconds_until(drive, lambda t: t.decision.status.state is RunState.STOPPED, limit=3.0)
    seconds_until(drive, stands, limit=2.0)
    assert "GNSS" in drive.ticks[-1].decision.status.stop_reason


def test_gnss_without_a_fix_that_is_apart_from_the_pose_is_waited_for(park: Park, farm: SiteMap) -> None:
    drive = on_the_road(park, farm)
    world = drive.lockstep.world
    world.faults = replace(world.faults, corrections_lost=True)
    seconds_until(drive, lambda t: t.decision.status.gnss_quality is FixQuality.RTK_FLOAT, limit=30.0)
    world.faults = replace(world.faults, gnss_off=(0.0, 3.0))
    seconds_until(drive, lambda t: "pose_apart" in events(t), limit=20.0)
    seconds_until(drive, stands, limit=3.0)
    world.faults = replace(world.faults, corrections_lost=False, gnss_off=(0.0, 0.0))
    seconds_until(drive, lambda t: t.truth.v > 0.3, limit=60.0)
    assert drive.ticks[-1].decision.status.state is RunState.DRIVING


def test_a_fixed_position_that_jumps_stops_the_robot_for_a_human(park: Park, farm: SiteMap) -> None:
    drive = on_the_road(park, farm)
    drive.lockstep.world.faults = replace(drive.lockstep.world.faults, gnss_off=(0.0, 3.0))
    seconds_until(drive, lambda t: t.decision.status.state is RunState.STOPPED, limit=10.0)
    assert "position is in doubt" in drive.ticks[-1].decision.status.stop_reason


def test_silent_gnss_does_not_matter_in_the_row(park: Park, farm: SiteMap) -> None:
    drive = in_the_row(park, farm)
    drive.lockstep.world.faults = replace(drive.lockstep.world.faults, gnss_silent=True)
    tick = drive.until(lambda t: t.decision.status.state is not RunState.DRIVING, seconds=8)
    assert tick.decision.status.state is RunState.DRIVING


def test_a_camera_that_falls_silent_before_the_next_row_lets_nobody_in(park: Park, farm: SiteMap) -> None:
    """The row was seen from the turn: that is no reason to drive into it blind."""
    drive = park(3)
    drive.start(farm, mission_for_row(farm, "r1", RowExit.NEXT_ROW))
    drive.until_mode(NavMode.HEADLAND)
    pilot = drive.lockstep.navigator.pilot
    assert pilot is not None
    drive.until(lambda _: pilot.before_seen_row, seconds=60)
    assert pilot.before_seen_row
    drive.lockstep.eye = None
    tick = drive.until(lambda tick: tick.decision.status.state is RunState.HOLDING, seconds=30)
    assert "entrance_unseen" in events(tick)
    ahead = pilot.to_start()
    assert ahead is not None
    assert ahead > 1.0  # m


def test_silent_camera_holds_in_the_row_and_goes_on_when_it_sees_again(park: Park, farm: SiteMap) -> None:
    drive = in_the_row(park, farm)
    eye, drive.lockstep.eye = drive.lockstep.eye, None
    assert seconds_until(drive, lambda t: "row_unseen" in events(t), limit=1.0) <= 0.6  # s
    tick = drive.until(stands, seconds=2)
    assert tick.decision.status.state is RunState.HOLDING
    assert tick.chassis.guard is GuardState.ARMED
    drive.lockstep.eye = eye
    assert drive.until(lambda t: t.truth.v > 0.3, seconds=5).truth.v > 0.3  # m/s


def test_a_robot_that_is_stuck_gives_up(park: Park, farm: SiteMap) -> None:
    drive = on_the_road(park, farm)
    drive.lockstep.world.faults = replace(drive.lockstep.world.faults, stuck=True)
    seconds_until(drive, lambda t: t.decision.status.state is RunState.STOPPED, limit=15.0)


def test_start_is_refused_with_every_reason_at_once(park: Park, farm: SiteMap) -> None:
    drive = park(7)
    drive.lockstep.ecu.state = VehicleState.EMERGENCY_STOP
    drive.lockstep.world.faults = replace(drive.lockstep.world.faults, gnss_silent=True)
    drive.until(lambda _: False, seconds=1)
    tick = drive.start(farm, mission_for_row(farm, "r1", RowExit.REVERSE))
    (reply,) = tick.decision.replies
    assert not reply.accepted
    assert len(reply.reasons) >= 2


def test_a_row_that_is_not_seen_is_not_entered(park: Park, farm: SiteMap) -> None:
    drive = on_the_road(park, farm)
    drive.lockstep.eye = None
    seconds_until(drive, lambda t: "entrance_unseen" in events(t), limit=80.0)
    tick = drive.until(stands, seconds=3)
    assert tick.decision.status.state is RunState.HOLDING
    row = drive.lockstep.world.site.row("r1")
    assert tick.truth.y < row.start[1]  # m: still before the entrance
