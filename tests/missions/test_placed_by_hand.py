"""Without GNSS the robot asks where it stands; told so by a press on the map, it finds its place and drives."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from navcore.drivers.nmea_stream import NmeaStream
from navcore.localization.lidar3d.map_localizer import MapLocalizer
from navcore.maps.mission import RowExit
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.messages import (
    FixQuality,
    GnssFix,
    MatchState,
    NavMode,
    Reply,
    Request,
    RequestKind,
    RunState,
    ToldPlace,
)
from navcore.planning.mission_planner import mission_for_row, plan_mission
from navcore.runtime.lockstep import Lockstep, Tick
from navcore.runtime.simulated_eye import ProjectedEye
from navcore.runtime.simulated_map_eye import SimulatedMapEye
from navcore.sim.world import World, WorldParams
from navcore.vehicle import PAPER_A
from tests.missions.conftest import CONFIG, Drive, small_farm
from tests.missions.mapped_farm import AS_DRAWN, MOUNT, lidar_of, mapped

FARM = small_farm()
DATUM = (FARM.datum.lat_deg, FARM.datum.lon_deg, FARM.datum.height_m)
OFF = (0.9, -1.1, math.radians(22.0))  # m, m, rad: as a person presses


@pytest.fixture(scope="module")
def farm_map() -> NdtMap:
    return mapped(World(FARM, PAPER_A, AS_DRAWN))


def parked(farm_map: NdtMap, params: WorldParams = AS_DRAWN) -> Drive:
    """A robot with a 3D LiDAR on its farm's map whose receiver is silent."""
    world = World(FARM, PAPER_A, params, start_ns=1_000_000_000)
    world.faults = replace(world.faults, gnss_silent=True)
    lockstep = Lockstep(
        world, CONFIG.new_navigator(FARM.datum), ProjectedEye(world.orchard, params.seed),
        map_eye=SimulatedMapEye(lidar_of(world, 11), MOUNT, MapLocalizer(farm_map)),
    )  # fmt: skip
    drive = Drive(lockstep)
    lockstep.listeners.append(drive.ticks.append)
    return drive


def place(drive: Drive, x: float, y: float, yaw: float, datum: tuple[float, float, float] = DATUM) -> Reply:
    told = ToldPlace(x=x, y=y, yaw=yaw, datum=datum)
    drive.lockstep.ask(Request(kind=RequestKind.PLACE, request_id="place", place=told))
    return drive.lockstep.tick().decision.replies[0]


def press(drive: Drive, off: tuple[float, float, float] = OFF) -> Reply:
    """Where the robot truly stands, as well as a person sees it."""
    truth = drive.ticks[-1].truth
    return place(drive, truth.x + off[0], truth.y + off[1], truth.yaw + off[2])


def events(tick: Tick) -> dict[str, str]:
    return {event.name: event.text for event in tick.decision.status.events}


def test_a_robot_placed_by_hand_finds_itself_and_drives_its_mission_on_the_map(farm_map: NdtMap) -> None:
    drive = parked(farm_map)
    # Right before a place was found by the map alone: the robot says what it wants.
    asking = drive.until(lambda tick: "place_unknown" in events(tick), seconds=2)
    assert "Say it on the map" in events(asking)["place_unknown"]
    assert press(drive).accepted
    last = drive.until(lambda tick: tick.decision.status.pose is not None, seconds=10)
    pose, truth = last.decision.status.pose, last.truth
    assert pose is not None
    assert math.dist((pose.x, pose.y), (truth.x, truth.y)) < 0.1  # m
    assert abs(math.remainder(pose.yaw - truth.yaw, 2 * math.pi)) < 0.02  # rad
    assert pose.source.startswith("map")
    drive.until(lambda _: False, seconds=1)
    assert "place_unknown" not in events(drive.ticks[-1])

    plan = plan_mission(FARM, mission_for_row(FARM, "r1", RowExit.REVERSE), PAPER_A)
    drive.lockstep.ask(Request(kind=RequestKind.START, request_id="start", run_id="run", plan=plan))
    assert drive.lockstep.tick().decision.replies[0].accepted
    drive.until_mode(NavMode.MAP, seconds=5)
    drive.until_mode(NavMode.ROW, seconds=100)
    assert all(tick.decision.status.gnss_age_s is None for tick in drive.ticks)
    assert drive.lockstep.world.touched == []


def test_nobody_says_where_a_robot_stands_that_drives(farm_map: NdtMap) -> None:
    drive = parked(farm_map)
    drive.until(lambda tick: bool(tick.inputs.matches), seconds=2)
    assert press(drive).accepted
    drive.until(lambda tick: tick.decision.status.pose is not None, seconds=10)
    drive.until(lambda _: False, seconds=1)
    plan = plan_mission(FARM, mission_for_row(FARM, "r1", RowExit.REVERSE), PAPER_A)
    drive.lockstep.ask(Request(kind=RequestKind.START, request_id="start", run_id="run", plan=plan))
    drive.until_state(RunState.DRIVING, seconds=5)
    reply = press(drive)
    assert reply.reasons == ("A mission is under way. Stop it before you say where the robot stands.",)
    drive.ask(RequestKind.STOP)
    drive.until_state(RunState.STOPPED, seconds=2)
    assert "Acknowledge the stop" in press(drive).reasons[0]


def test_a_place_that_makes_no_sense_is_refused_with_every_reason(farm_map: NdtMap) -> None:
    drive = parked(farm_map)
    drive.until(lambda tick: bool(tick.inputs.matches), seconds=2)
    assert "Press on the map" in place(drive, math.nan, 0.0, 0.0).reasons[0]
    assert "another farm" in place(drive, 0.0, 0.0, 0.0, (0.0, 0.0, 0.0)).reasons[0]
    drive.lockstep.map_eye = None
    drive.until(lambda _: False, seconds=3)
    assert "No 3D LiDAR reports" in press(drive).reasons[0]


def test_rtk_needs_nobody_to_say_where_the_robot_stands(farm_map: NdtMap) -> None:
    drive = parked(farm_map)
    world = drive.lockstep.world
    world.faults = replace(world.faults, gnss_silent=False)
    drive.until(lambda tick: tick.decision.status.pose is not None, seconds=6)
    drive.until(lambda tick: bool(tick.inputs.matches), seconds=2)
    assert "RTK knows" in press(drive).reasons[0]


def test_rtk_that_comes_later_and_disagrees_with_the_map_is_a_dispute(farm_map: NdtMap) -> None:
    drive = parked(farm_map)
    drive.until(lambda tick: bool(tick.inputs.matches), seconds=2)
    assert press(drive).accepted
    drive.until(lambda tick: tick.decision.status.pose is not None, seconds=10)
    world = drive.lockstep.world
    world.faults = replace(world.faults, gnss_silent=False, gnss_off=(0.0, 2.0))
    drive.until(lambda tick: drive.lockstep.navigator.senses.on_map.disputed, seconds=6)
    assert "apart" in drive.lockstep.navigator.senses.on_map.reason


def test_rtk_that_comes_later_and_agrees_changes_nothing(farm_map: NdtMap) -> None:
    drive = parked(farm_map)
    drive.until(lambda tick: bool(tick.inputs.matches), seconds=2)
    assert press(drive).accepted
    drive.until(lambda tick: tick.decision.status.pose is not None, seconds=10)
    world = drive.lockstep.world
    world.faults = replace(world.faults, gnss_silent=False)
    began = len(drive.ticks)
    drive.until(lambda _: False, seconds=6)
    off = [
        math.dist((pose.x, pose.y), (tick.truth.x, tick.truth.y))
        for tick in drive.ticks[began:]
        if (pose := tick.decision.status.pose) is not None
    ]
    assert len(off) > 250
    assert max(off) < 0.15  # m
    assert not drive.lockstep.navigator.senses.on_map.disputed


class WeakReceiver:
    """A receiver without corrections: metres off, and its two antennas may agree on a wrong heading."""

    def __init__(self, receiver: NmeaStream, turned: float) -> None:
        self._receiver, self._turned = receiver, turned

    def feed(self, data: bytes, received_ns: int) -> tuple[GnssFix, ...]:
        return tuple(self._weak(fix) for fix in self._receiver.feed(data, received_ns))

    def _weak(self, fix: GnssFix) -> GnssFix:
        lat_deg = None if fix.lat_deg is None else fix.lat_deg + 2.5 / 111_200.0
        heading = None if fix.heading_rad is None else fix.heading_rad + self._turned
        return replace(
            fix, quality=FixQuality.SINGLE, lat_deg=lat_deg, std_east_m=1.5, std_north_m=1.5, heading_rad=heading
        )


def with_weak_gnss(farm_map: NdtMap, turned: float) -> Drive:
    drive = parked(farm_map)
    drive.lockstep.world.faults = replace(drive.lockstep.world.faults, gnss_silent=False)
    drive.lockstep.receiver = WeakReceiver(drive.lockstep.receiver, turned)  # type: ignore[assignment]
    return drive


def off_by(tick: Tick) -> float:
    pose = tick.decision.status.pose
    return math.inf if pose is None else math.dist((pose.x, pose.y), (tick.truth.x, tick.truth.y))


def test_fixes_without_corrections_tell_where_to_search_and_the_map_tells_the_place(farm_map: NdtMap) -> None:
    drive = with_weak_gnss(farm_map, turned=0.0)
    first = drive.until(lambda tick: tick.decision.status.pose is not None, seconds=3)
    assert off_by(first) > 2.0  # m
    last = drive.until(lambda tick: off_by(tick) < 0.1, seconds=8)
    assert off_by(last) < 0.1  # m
    assert all(off_by(tick) < 0.15 for tick in (drive.lockstep.tick() for _ in range(100)))  # m


def test_a_word_stands_against_a_receiver_that_looks_the_wrong_way(farm_map: NdtMap) -> None:
    drive = with_weak_gnss(farm_map, turned=0.4)
    drive.until(lambda _: False, seconds=5)
    assert "place_unknown" in events(drive.ticks[-1])
    assert press(drive).accepted
    last = drive.until(lambda tick: off_by(tick) < 0.1, seconds=8)
    assert off_by(last) < 0.1  # m
    pose = last.decision.status.pose
    assert pose is not None
    assert abs(math.remainder(pose.yaw - last.truth.yaw, 2 * math.pi)) < 0.02  # rad


def test_told_nothing_only_a_match_that_may_be_believed_starts_the_pose(farm_map: NdtMap) -> None:
    """The map is searched; until one place clearly leads, nothing is told as a place."""
    drive = parked(farm_map)
    last = drive.until(lambda tick: tick.decision.status.pose is not None, seconds=8)
    pose = last.decision.status.pose
    if pose is None:
        states = {match.state for tick in drive.ticks for match in tick.inputs.matches}
        assert MatchState.MATCHED not in states
        return
    assert math.dist((pose.x, pose.y), (last.truth.x, last.truth.y)) < 0.1  # m
