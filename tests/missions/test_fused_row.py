"""With camera and LiDAR the robot drives the row closer to its middle and maps its trunks.

It loses either in mid-row and drives on.
"""

from __future__ import annotations

import math
import statistics
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial import KDTree

from navcore.mapping.trunks_seen import trunks_of_views
from navcore.mapping.whole_shift import whole_shift
from navcore.maps.mission import RowExit
from navcore.maps.site_map import Row, SiteMap
from navcore.maps.trunk_map import RowTrunk, TrunkMap, trunks_of_row
from navcore.messages import NavMode, RowObservation, RowSource, RunState
from navcore.planning.mission_planner import mission_for_row
from navcore.runtime.simulated_eye import ProjectedEye
from navcore.sim.lidar2d import Lidar2dFaults, Lidar2dParams
from navcore.sim.world import WorldParams
from tests.missions.conftest import Drive, new_drive, small_farm

FINISH_S = 600


def drive_into_row(farm: SiteMap) -> Drive:
    """Three seconds into a row, with camera and LiDAR."""
    drive = new_drive(farm, WorldParams(seed=1, lidar2d=Lidar2dParams()))
    drive.start(farm, mission_for_row(farm, "r1", RowExit.REVERSE))
    drive.until_mode(NavMode.ROW)
    drive.until(lambda _: False, seconds=3)
    return drive


@pytest.fixture
def in_row(farm: SiteMap) -> Drive:
    """A drive to break something on."""
    return drive_into_row(farm)


@pytest.fixture(scope="module")
def driven() -> Drive:
    """A whole one on which nothing breaks."""
    drive = drive_into_row(small_farm())
    finish(drive)
    return drive


def seen(drive: Drive) -> list[RowObservation]:
    """All rows seen so far."""
    return [view.row for tick in drive.ticks for view in tick.views]


def finish(drive: Drive) -> None:
    last = drive.until_state(RunState.FINISHED, RunState.STOPPED, seconds=FINISH_S)
    assert last.decision.status.state is RunState.FINISHED, last.decision.status.events
    assert drive.lockstep.world.touched == []


def test_robot_drives_into_a_row_and_back_out_by_camera_and_lidar(driven: Drive) -> None:
    fused = [row.source is RowSource.FUSED for row in seen(driven) if row.valid]
    assert statistics.mean(fused) > 0.9
    lateral = [abs(e) for e in driven.lateral_in_rows()]
    assert statistics.mean(lateral) < 0.04  # m
    assert max(lateral) < 0.25  # m


def test_robot_maps_the_trunks_of_a_row_that_it_drives_in_and_out(driven: Drive, farm: SiteMap) -> None:
    """A run with camera and LiDAR leaves a map of the trunks that it passed."""
    mapped = trunks_of_row(_map(driven, farm), farm.row("r1"))
    true = _true(driven, driven.lockstep.world.site.row("r1"))
    places = np.array([(t.along, t.lateral) for t in mapped])
    shift = whole_shift(places, true[:, :2], 1.0)  # the row as drawn lies up to that far beside the true one, m
    places += np.array((shift.x, shift.y))
    distance, nearest = map(np.asarray, KDTree(true[:, :2]).query(places))
    found = distance < 0.4  # m
    error = (places - true[nearest, :2])[found]
    assert len(set(nearest[found])) >= 0.95 * len(true)
    assert (~found).sum() <= 3  # weeds and stakes that stand like trunks
    assert math.sqrt(float(np.mean(error[:, 0] ** 2))) < 0.12  # m, along: how far apart they stand, after 25 m
    assert math.sqrt(float(np.mean(error[:, 1] ** 2))) < 0.07  # m, across
    diameter = np.array([t.trunk.diameter for t in mapped])[found]
    assert float(np.median(np.abs(diameter - true[nearest, 2][found]))) < 0.01  # m
    _assert_ids_are_the_runs(mapped)


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


def _map(drive: Drive, farm: SiteMap) -> TrunkMap:
    views = [view for tick in drive.ticks for view in tick.views]
    poses = [tick.decision.status.pose for tick in drive.ticks if tick.decision.status.pose is not None]
    return trunks_of_views(views, poses, farm.rows, "run")


def _true(drive: Drive, row: Row) -> NDArray[np.float64]:
    """(N, 3) along the true row, across, diameter of what stands on its two lines, m."""
    orchard = drive.lockstep.world.orchard
    stands = np.vstack((orchard.posts, orchard.trunks))
    u = np.subtract(row.end, row.start) / math.dist(row.start, row.end)
    along, across = (stands[:, :2] - row.start) @ u, (stands[:, :2] - row.start) @ (-u[1], u[0])
    beside = np.abs(np.abs(across) - row.width / 2.0) < 0.6
    on = beside & (along > -0.5) & (along < math.dist(row.start, row.end) + 0.5)
    return np.asarray(np.column_stack((along, across, 2.0 * stands[:, 4]))[on])


def _assert_ids_are_the_runs(mapped: tuple[RowTrunk, ...]) -> None:
    assert all(t.trunk.id.startswith("run-") for t in mapped)
    assert len({(t.trunk.id, t.side) for t in mapped}) == len(mapped)
