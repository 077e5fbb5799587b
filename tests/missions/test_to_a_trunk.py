"""The robot drives to a trunk of the trunk map, waits beside it for the operator, and comes home."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.geometry.se2 import SE2
from navcore.maps.mission import Mission, RowExit
from navcore.maps.site_map import Row, SiteMap
from navcore.maps.trunk_map import MappedTrunk, TrunkMap, trunks_of_row
from navcore.messages import NavMode, RequestKind, RunState
from navcore.planning.mission_planner import mission_for_row
from navcore.sim.lidar2d import Lidar2dParams
from navcore.sim.world import World, WorldParams
from tests.missions.conftest import Drive, new_drive

ROW = "r1"
FINISH_S = 600


def frame(row: Row) -> SE2:
    return SE2(*row.start, math.atan2(row.end[1] - row.start[1], row.end[0] - row.start[0]))


def mapped(site: SiteMap, world: World) -> TrunkMap:
    """What stands along the true row, as a mapping run puts it beside the drawn one."""
    true, drawn = frame(world.site.row(ROW)), frame(site.row(ROW))
    plants = np.concatenate((world.orchard.trunks, world.orchard.posts))
    placed = [(drawn @ true.inverse() @ SE2(float(p[0]), float(p[1]), 0.0), float(p[4])) for p in plants]
    return TrunkMap(
        trunks=tuple(
            MappedTrunk(id=f"t{k}", x=at.x, y=at.y, std=0.03, diameter=2 * radius)
            for k, (at, radius) in enumerate(placed)
        )
    )


def along(drive: Drive) -> float:
    """Where the robot truly is along the true row, m."""
    truth = drive.ticks[-1].truth
    return (frame(drive.lockstep.world.site.row(ROW)).inverse() @ SE2(truth.x, truth.y, 0.0)).x


def drive_to_trunk(site: SiteMap, params: WorldParams, near: float) -> tuple[Drive, float]:
    """Robot that has stopped at the left trunk nearest to `near` m, and where along the true row that stands, m."""
    drive = new_drive(site, params)
    trunks = mapped(site, drive.lockstep.world)
    left = [t for t in trunks_of_row(trunks, site.row(ROW)) if t.side == 1]
    target = min(left, key=lambda t: abs(t.along - near))
    mission = to_trunk(mission_for_row(site, ROW, RowExit.REVERSE), target.trunk.id)
    drive.start(site, mission, trunks)
    drive.until_mode(NavMode.ROW)
    last = drive.until_state(RunState.PAUSED, RunState.STOPPED, RunState.FINISHED, seconds=FINISH_S)
    assert last.decision.status.state is RunState.PAUSED, last.decision.status.events
    words = [event.text for event in last.decision.status.events]
    assert f"At row Row 2, {target.name}. Resume to go on." in words
    assert last.decision.status.mode is NavMode.ROW
    return drive, target.along


def to_trunk(mission: Mission, trunk: str) -> Mission:
    visit = replace(mission.visits[0], from_start=True, stop_at=trunk)
    return replace(mission, visits=(visit,))


def go_home(drive: Drive) -> None:
    drive.until(lambda _: False, seconds=2)
    assert drive.ticks[-1].decision.status.state is RunState.PAUSED
    drive.ask(RequestKind.RESUME)
    last = drive.until_state(RunState.FINISHED, RunState.STOPPED, seconds=FINISH_S)
    assert last.decision.status.state is RunState.FINISHED, last.decision.status.events
    assert drive.lockstep.world.touched == []


@pytest.mark.parametrize("near", [8.0, 14.0])
def test_robot_stops_at_the_trunk_and_comes_home_when_it_is_resumed(farm: SiteMap, near: float) -> None:
    drive, there = drive_to_trunk(farm, WorldParams(seed=1, lidar2d=Lidar2dParams()), near)
    assert along(drive) == pytest.approx(there, abs=0.15)  # m
    go_home(drive)


def test_without_a_lidar_the_robot_stops_near_the_trunk(farm: SiteMap) -> None:
    drive, there = drive_to_trunk(farm, WorldParams(seed=1), 14.0)
    assert along(drive) == pytest.approx(there, abs=1.5)  # m
    go_home(drive)
