"""The guard's limits are the vehicle's: one that is held to less has its turns cut with its speed."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from navcore.config import RobotConfig
from navcore.runtime.lockstep import Lockstep
from navcore.runtime.processes import CanSettings, Robot, guard_arguments
from navcore.sim.world import World, WorldParams
from navcore.vehicle import PROFILES, SCOUT_2
from tests.missions.conftest import small_farm


@pytest.mark.parametrize("name", PROFILES)
def test_the_guard_lets_through_what_the_navigator_may_ask_of_the_vehicle(name: str) -> None:
    site, config = small_farm(), replace(RobotConfig(), vehicle=name)
    world = World(site, config.vehicle_params(), WorldParams(), start_ns=1)
    limits = Lockstep(world, config.new_navigator(site.datum), None).guard.params.limits
    assert (limits.max_speed, limits.max_turn_rate) == (PROFILES[name].max_speed, PROFILES[name].max_turn_rate)


@pytest.mark.parametrize("name", PROFILES)
def test_the_guard_is_started_with_the_limits_of_the_vehicle(name: str, tmp_path: Path) -> None:
    robot = Robot(
        bus=tmp_path, site=tmp_path / "site.json", vehicle=name, can=CanSettings(), gnss="tcp://localhost:1"
    )
    told = guard_arguments(robot)
    assert float(told[told.index("--max-speed") + 1]) == PROFILES[name].max_speed
    assert float(told[told.index("--max-turn-rate") + 1]) == PROFILES[name].max_turn_rate


def test_a_scout_is_held_to_what_its_manual_allows() -> None:
    assert SCOUT_2.max_speed == 1.5  # m/s
