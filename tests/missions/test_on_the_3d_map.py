"""Where neither GNSS nor a row tells the way, the robot drives on the 3D map, and nowhere else."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest

from navcore.localization.lidar3d.map_localizer import MapLocalizer
from navcore.maps.mission import RowExit
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.messages import GhostSource, MatchState, NavMode, RunState
from navcore.planning.mission_planner import mission_for_row
from navcore.runtime.lockstep import Lockstep, Tick
from navcore.runtime.simulated_eye import ProjectedEye
from navcore.runtime.simulated_map_eye import SimulatedMapEye
from navcore.sim.lidar3d import Lidar3dFaults
from navcore.sim.world import World
from navcore.vehicle import PAPER_A
from tests.missions.conftest import CONFIG, Drive, small_farm
from tests.missions.mapped_farm import AS_DRAWN, MOUNT, lidar_of, mapped


@pytest.fixture(scope="module")
def farm_map() -> NdtMap:
    return mapped(World(small_farm(), PAPER_A, AS_DRAWN))


@pytest.fixture(scope="module")
def park_on_map(farm_map: NdtMap) -> Callable[[], Drive]:
    """A parked robot with a 3D LiDAR on its farm's map."""

    def parked() -> Drive:
        farm = small_farm()
        world = World(farm, PAPER_A, AS_DRAWN, start_ns=1_000_000_000)
        lockstep = Lockstep(
            world, CONFIG.new_navigator(farm.datum), ProjectedEye(world.orchard, AS_DRAWN.seed),
            map_eye=SimulatedMapEye(lidar_of(world, 11), MOUNT, MapLocalizer(farm_map)),
        )  # fmt: skip
        drive = Drive(lockstep)
        lockstep.listeners.append(drive.ticks.append)
        drive.start(farm, mission_for_row(farm, "r1", RowExit.REVERSE))
        return drive

    return parked


@dataclass(frozen=True, slots=True)
class Blinded:
    """A whole mission whose camera goes blind in the row; in which ticks the row took over, and then the map."""

    drive: Drive
    in_row: int
    on_map: int


@pytest.fixture(scope="module")
def blinded(park_on_map: Callable[[], Drive]) -> Blinded:
    drive = park_on_map()
    drive.until_mode(NavMode.ROW)
    in_row = len(drive.ticks) - 1
    drive.until(lambda _: False, seconds=5)
    eye = drive.lockstep.eye
    assert isinstance(eye, ProjectedEye)
    eye.blind = True
    drive.until_mode(NavMode.MAP, seconds=2)
    on_map = len(drive.ticks)
    drive.until_state(RunState.FINISHED, RunState.STOPPED, seconds=600)
    return Blinded(drive, in_row, on_map)


def map_errors(ticks: list[Tick]) -> list[float]:
    """Of all matches, m: places as told against the truth of that moment."""
    truth = {tick.truth.stamp_ns: tick.truth for tick in ticks}
    matches = [m for tick in ticks for m in tick.inputs.matches if m.state is MatchState.MATCHED]
    return [math.dist((m.x, m.y), (truth[m.stamp_ns].x, truth[m.stamp_ns].y)) for m in matches if m.stamp_ns in truth]


def test_the_map_drives_on_through_a_row_when_the_camera_goes_blind(blinded: Blinded) -> None:
    drive = blinded.drive
    last = drive.ticks[-1]
    assert last.decision.status.state is RunState.FINISHED, last.decision.status.events
    assert drive.lockstep.world.touched == []
    errors = map_errors(drive.ticks[blinded.on_map :])
    assert len(errors) > 100
    assert float(np.mean(errors)) < 0.04  # m


def test_a_robot_without_a_map_waits_where_the_camera_goes_blind(park_on_map: Callable[[], Drive]) -> None:
    drive = park_on_map()
    drive.lockstep.map_eye = None
    drive.until_mode(NavMode.ROW)
    eye = drive.lockstep.eye
    assert isinstance(eye, ProjectedEye)
    eye.blind = True
    last = drive.until_state(RunState.STOPPED, seconds=60)
    assert "waited too long" in last.decision.status.stop_reason


def test_the_map_takes_over_on_the_road_while_gnss_has_no_fix(park_on_map: Callable[[], Drive]) -> None:
    drive = park_on_map()
    drive.until(lambda _: False, seconds=3)
    world = drive.lockstep.world
    world.faults = replace(world.faults, corrections_lost=True)
    drive.until_mode(NavMode.MAP, seconds=30)
    drive.until_mode(NavMode.ROW_ENTRY, seconds=100)
    assert [switch.after for switch in drive.switches] == [NavMode.MAP, NavMode.ROW_ENTRY]
    off = [abs(tick.decision.status.lateral_error or 0.0) for tick in drive.ticks]
    assert max(off) < 0.3  # m
    assert float(np.mean(map_errors(drive.ticks))) < 0.05  # m


def test_four_ghosts_say_how_far_they_are_from_the_driven_pose(blinded: Blinded) -> None:
    entered = blinded.drive.ticks[blinded.in_row]
    assert entered.decision.status.mode is NavMode.ROW
    ghosts = {ghost.source: ghost for ghost in entered.decision.status.ghosts}
    assert set(ghosts) == set(GhostSource)
    assert ghosts[GhostSource.ROWS].apart < 0.05  # m
    assert ghosts[GhostSource.MAP].apart < 0.3  # m


def test_gnss_that_lies_by_two_metres_and_calls_itself_fixed_is_noticed_and_stops_the_robot(
    park_on_map: Callable[[], Drive],
) -> None:
    drive = park_on_map()
    drive.until(lambda _: False, seconds=5)
    world = drive.lockstep.world
    world.faults = replace(world.faults, gnss_off=(0.0, 2.0))
    last = drive.until_state(RunState.STOPPED, seconds=3)
    assert "position is in doubt" in last.decision.status.stop_reason
    drive.until(lambda _: False, seconds=2)
    pose, truth = drive.ticks[-1].decision.status.gnss_pose, drive.ticks[-1].truth
    assert pose is not None
    assert math.dist((pose.x, pose.y), (truth.x, truth.y)) < 0.1  # m: the lie does not move the pose


def test_a_lidar_that_leans_out_of_its_mount_is_told_while_the_robot_drives(park_on_map: Callable[[], Drive]) -> None:
    drive = park_on_map()
    map_eye = drive.lockstep.map_eye
    assert isinstance(map_eye, SimulatedMapEye)
    map_eye.faults = Lidar3dFaults(turned=(math.radians(5.0), 0.0, 0.0))
    last = drive.until(lambda tick: told(tick, "leans 5 degrees to the right"), seconds=30)
    assert told(last, "leans 5 degrees to the right"), last.decision.status.events
    assert last.decision.status.state is RunState.DRIVING


def test_a_covered_lidar_is_told_and_a_wet_one_too(park_on_map: Callable[[], Drive]) -> None:
    drive = park_on_map()
    map_eye = drive.lockstep.map_eye
    assert isinstance(map_eye, SimulatedMapEye)
    drive.until(lambda _: False, seconds=2)
    map_eye.faults = Lidar3dFaults(rain=0.3)
    assert told(drive.until(lambda tick: told(tick, "Rain, snow or dust"), seconds=3), "Rain, snow or dust")
    map_eye.faults = Lidar3dFaults(empty=True)
    assert told(drive.until(lambda tick: told(tick, "sees nothing"), seconds=2), "sees nothing")


def told(tick: Tick, words: str) -> bool:
    """Whether an event on Drive says so."""
    return any(words in event.text for event in tick.decision.status.events)
