"""A small farm and a robot to drive on it, in simulated time."""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable
from dataclasses import dataclass, field

import pytest

from navcore.config import RobotConfig
from navcore.maps.mission import Mission
from navcore.maps.site_map import Datum, Lane, Row, SiteMap, Warehouse
from navcore.maps.trunk_map import TrunkMap
from navcore.messages import ModeSwitch, NavMode, Request, RequestKind, RunState
from navcore.planning.mission_planner import plan_mission
from navcore.runtime.lockstep import Lockstep, Tick
from navcore.runtime.simulated_eye import ProjectedEye
from navcore.sim.world import World, WorldParams
from navcore.vehicle import PAPER_A

CONFIG = RobotConfig()


def small_farm() -> SiteMap:
    """Four rows of 25 m, 3 m apart, a headland with a road before them, a warehouse at the road."""
    rows = tuple(
        Row(id=f"r{i}", name=f"Row {i + 1}", start=(20.0 + 3.0 * i, 0.0), end=(20.0 + 3.0 * i, 25.0))
        for i in range(4)
    )
    road = Lane(id="road", points=((10.0, -12.0), (32.0, -12.0)), width=4.0)
    return SiteMap(
        name="Small farm",
        datum=Datum(lat_deg=31.4, lon_deg=120.9, height_m=8.0),
        warehouse=Warehouse(x=10.0, y=-12.0, yaw=0.0),
        lanes=(road,),
        rows=rows,
    )


@pytest.fixture
def farm() -> SiteMap:
    """The small farm."""
    return small_farm()


@dataclass
class Drive:
    """One mission under way, and what happened on it."""

    lockstep: Lockstep
    ticks: list[Tick] = field(default_factory=list)

    def start(self, site: SiteMap, mission: Mission, trunks: TrunkMap = TrunkMap()) -> Tick:
        """Wait for the first position, then start; the tick after the request."""
        plan = plan_mission(site, mission, PAPER_A, trunks=trunks)
        self.until(lambda tick: tick.decision.status.pose is not None, seconds=4)
        self.until(lambda _: False, seconds=2)
        request = Request(kind=RequestKind.START, request_id="start", run_id="run", plan=plan)
        self.lockstep.ask(request)
        return self.lockstep.tick()

    def ask(self, kind: RequestKind) -> Tick:
        """Hand a request to the navigator; the tick that answered it."""
        self.lockstep.ask(Request(kind=kind, request_id=kind.value))
        return self.lockstep.tick()

    def until_mode(self, mode: NavMode, seconds: float = 200) -> Tick:
        """Drive until this mode; fails if it does not come."""
        tick = self.until(lambda tick: tick.decision.status.mode is mode, seconds)
        assert tick.decision.status.mode is mode, tick.decision.status
        return tick

    def until(self, condition: Callable[[Tick], bool], seconds: float) -> Tick:
        """Drive until something holds, for at most so many simulated seconds."""
        return self.lockstep.run(seconds, condition)

    def until_state(self, *states: RunState, seconds: float) -> Tick:
        """Drive until the mission is in one of these states."""
        return self.until(lambda tick: tick.decision.status.state in states, seconds)

    @property
    def switches(self) -> list[ModeSwitch]:
        """All mode switches so far."""
        return [tick.decision.switch for tick in self.ticks if tick.decision.switch is not None]

    def lateral_in_rows(self) -> list[float]:
        """True distance from the true row's centre line at every tick driven on the camera, m."""
        rows = {row.id: row for row in self.lockstep.world.site.rows}
        return [
            off_line(tick, rows[tick.decision.status.row_id].start, rows[tick.decision.status.row_id].end)
            for tick in self.ticks
            if tick.decision.status.mode is NavMode.ROW and tick.decision.status.row_id in rows
        ]


def assert_driven_in_and_out(drive: Drive) -> None:
    """A whole mission into a row and back: finished, close to its middle, entered before driven on the camera."""
    last = drive.ticks[-1]
    assert last.decision.status.state is RunState.FINISHED, last.decision.status.events
    lateral = [abs(e) for e in drive.lateral_in_rows()]
    assert statistics.mean(lateral) < 0.10  # m
    assert max(lateral) < 0.30  # m
    assert [s.after for s in drive.switches][:2] == [NavMode.ROW_ENTRY, NavMode.ROW]


def off_line(tick: Tick, start: tuple[float, float], end: tuple[float, float]) -> float:
    """Signed distance of the true robot from a line, m, positive on its left."""
    heading = math.atan2(end[1] - start[1], end[0] - start[0])
    dx, dy = tick.truth.x - start[0], tick.truth.y - start[1]
    return math.cos(heading) * dy - math.sin(heading) * dx


def new_drive(site: SiteMap, params: WorldParams) -> Drive:
    """A parked robot on the site that `params` make of the drawn one."""
    world = World(site, PAPER_A, params, start_ns=1_000_000_000)
    eye = ProjectedEye(world.orchard, params.seed, lidar=params.lidar_mount if params.lidar2d else None)
    lockstep = Lockstep(world, CONFIG.new_navigator(site.datum), eye)
    drive = Drive(lockstep)
    lockstep.listeners.append(drive.ticks.append)
    return drive


@pytest.fixture
def park(farm: SiteMap) -> Callable[[int], Drive]:
    """A parked robot in a world of that seed."""
    return lambda seed: new_drive(farm, WorldParams(seed=seed))
