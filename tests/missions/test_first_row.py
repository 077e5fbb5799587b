"""The robot drives from the warehouse into a row and back out, in spite of a wrong map and no GNSS in the row."""

from __future__ import annotations

from collections.abc import Callable

from navcore.maps.mission import RowExit
from navcore.maps.site_map import SiteMap
from navcore.messages import CameraView, NavMode, RunState
from navcore.planning.mission_planner import mission_for_row
from navcore.sim.demo_farm import demo_farm
from navcore.sim.world import WorldParams
from navcore.transport.codec import decode, encode
from tests.missions.conftest import Drive, assert_driven_in_and_out, new_drive


def test_robot_drives_into_a_row_and_back_out_in_reverse(park: Callable[[int], Drive], farm: SiteMap) -> None:
    drive = park(1)
    drive.start(farm, mission_for_row(farm, "r1", RowExit.REVERSE))
    drive.until_state(RunState.FINISHED, RunState.STOPPED, seconds=600)
    assert_driven_in_and_out(drive)


def test_the_row_that_is_meant_is_entered_although_a_first_look_fits_between_two() -> None:
    """On this farm the first pictures, half turned towards the row, fit a corridor that creeps to the neighbour."""
    site = demo_farm()
    drive = new_drive(site, WorldParams(seed=1))
    drive.start(site, mission_for_row(site, "row-4", RowExit.REVERSE))
    drive.until_mode(NavMode.ROW)
    drive.until(lambda _: False, seconds=3)
    assert max(abs(e) for e in drive.lateral_in_rows()) < 0.30  # m
    views = [view for tick in drive.ticks for view in tick.views]
    assert all(decode(CameraView, encode(view)) == view for view in views)
