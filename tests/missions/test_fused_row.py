"""With camera and LiDAR the robot drives the row closer to its middle; it loses either in mid-row and drives on."""

from __future__ import annotations

import statistics
from dataclasses import replace

import pytest

from navcore.maps.mission import RowExit
from navcore.maps.site_map import SiteMap
from navcore.messages import NavMode, RowObservation, RowSource, RunState
from navcore.planning.mission_planner import mission_for_row
from navcore.runtime.simulated_eye import ProjectedEye
from navcore.sim.lidar2d import Lidar2dFaults, Lidar2dParams
from navcore.sim.world import WorldParams
from tests.missions.conftest import Drive, new_drive

FINISH_S = 600


@pytest.fixture
def in_row(farm: SiteMap) -> Drive:
    """Three seconds into a row, with camera and LiDAR."""
    drive = new_drive(farm, WorldParams(seed=1, lidar2d=Lidar2dParams()))
    drive.start(farm, mission_for_row(farm, "r1", RowExit.REVERSE))
    drive.until_mode(NavMode.ROW)
    drive.until(lambda _: False, seconds=3)
    return drive


def seen(drive: Drive) -> list[RowObservation]:
    """All rows seen so far."""
    return [view.row for tick in drive.ticks for view in tick.views]


def finish(drive: Drive) -> None:
    last = drive.until_state(RunState.FINISHED, RunState.STOPPED, seconds=FINISH_S)
    assert last.decision.status.state is RunState.FINISHED, last.decision.status.events
    assert drive.lockstep.world.touched == []


def test_robot_drives_into_a_row_and_back_out_by_camera_and_lidar(in_row: Drive) -> None:
    finish(in_row)
    fused = [row.source is RowSource.FUSED for row in seen(in_row) if row.valid]
    assert statistics.mean(fused) > 0.9
    lateral = [abs(e) for e in in_row.lateral_in_rows()]
    assert statistics.mean(lateral) < 0.04  # m
    assert max(lateral) < 0.25  # m


def test_the_lidar_is_unplugged_in_mid_row_and_the_mission_goes_on(in_row: Drive) -> None:
    world = in_row.lockstep.world
    world.faults = replace(world.faults, lidar=Lidar2dFaults(silent=True))
    in_row.until(lambda _: False, seconds=2)
    last = seen(in_row)[-1]
    assert last.source is RowSource.CAMERA
    assert "the LiDAR has been silent for" in last.missing
    finish(in_row)


def test_the_camera_is_unplugged_in_mid_row_and_the_mission_goes_on(in_row: Drive) -> None:
    eye = in_row.lockstep.eye
    assert isinstance(eye, ProjectedEye)
    eye.blind = True
    in_row.until(lambda _: False, seconds=2)
    last = seen(in_row)[-1]
    assert last.valid, last.reason
    assert last.source is RowSource.LIDAR
    assert last.missing == "the camera gives no picture"
    finish(in_row)
    assert max(abs(e) for e in in_row.lateral_in_rows()) < 0.25  # m
