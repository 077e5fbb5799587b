"""A surveyed vineyard becomes a site, and a drive recorded there is followed as a mission."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from navcore.geometry.geodesy import EnuFrame
from navcore.maps.geojson import import_site
from navcore.maps.site_map import SiteMap
from navcore.messages import MissionPlan, Request, RequestKind, RunState
from navcore.planning.recorded_drive import followable_drive, plan_for_drive
from navcore.runtime.lockstep import Lockstep, Tick
from navcore.sim.map_error import NO_MAP_ERROR
from navcore.sim.orchard import OrchardParams, Season, Trellis
from navcore.sim.world import World, WorldParams
from navcore.vehicle import PAPER_A
from tests.missions.conftest import CONFIG

DRIVEN_M = 60.0


def vineyard(shared_data: Path) -> SiteMap:
    posts = json.loads((shared_data / "riseholme" / "riseholme_rtk_gps_poles.geojson").read_text())
    return import_site(posts).site


def recorded_plan(shared_data: Path, site: SiteMap) -> MissionPlan:
    """The recorded drive as a plan. Its metres are counted from the topological map's datum."""
    frame = EnuFrame(site.datum)
    table = np.genfromtxt(shared_data / "riseholme" / "tue02sep.csv", delimiter=",", names=True)
    east, north, _ = frame.to_enu(53.26810042662116, -0.5244249078498293, site.datum.height_m)
    drive = followable_drive(np.column_stack((table["x_m"] + east, table["y_m"] + north)))
    datum = (site.datum.lat_deg, site.datum.lon_deg, site.datum.height_m)
    return plan_for_drive(drive, mission_id="recorded", name="Recorded drive", datum=datum, vehicle=PAPER_A)


@pytest.mark.slow
def test_the_recorded_drive_is_followed_as_a_mission(shared_data: Path) -> None:
    site = vineyard(shared_data)
    plan = recorded_plan(shared_data, site)
    (x0, y0), (x1, y1) = plan.segments[0].points[0], plan.segments[0].points[5]
    params = WorldParams(
        seed=3, start=(x0, y0, math.atan2(y1 - y0, x1 - x0)), map_error=NO_MAP_ERROR,
        orchard=OrchardParams(trellis=Trellis.VSP, season=Season.DORMANT),
    )  # fmt: skip
    world = World(site, PAPER_A, params, start_ns=1_000_000_000)
    lockstep = Lockstep(world, CONFIG.new_navigator(site.datum), None)
    lockstep.run(20.0, lambda tick: tick.decision.status.pose is not None)
    lockstep.run(2.0)
    lockstep.ask(Request(kind=RequestKind.START, request_id="start", run_id="recorded", plan=plan))
    off = _drive(lockstep)
    assert len(off) > 50.0 / 0.8 * 50, lockstep.navigator.state
    assert np.mean(off) < 0.10  # m
    assert np.max(off[500:]) < 0.35  # m


def _drive(lockstep: Lockstep) -> list[float]:
    """True distance from the path at every driven tick, until far enough."""
    off: list[float] = []

    def done(tick: Tick) -> bool:
        pilot = lockstep.navigator.pilot
        if pilot is not None and tick.decision.status.state is RunState.DRIVING:
            off.append(abs(pilot.leg.line.project(tick.truth.x, tick.truth.y, pilot.place.s).lateral))
        far = pilot is not None and pilot.route.driven(pilot.place) > DRIVEN_M
        return far or tick.decision.status.state in (RunState.STOPPED, RunState.FINISHED)

    lockstep.run(400.0, done)
    return off
