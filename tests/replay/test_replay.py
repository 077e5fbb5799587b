"""A recorded run replays to the same decisions, byte for byte; a changed one does not."""

from __future__ import annotations

from dataclasses import replace

import pytest

from navcore.config import RobotConfig
from navcore.maps.mission import RowExit
from navcore.messages import Decision, NavInputs, NavMode
from navcore.mission.driver import DriverParams
from navcore.navigator import NavigatorParams
from navcore.planning.mission_planner import mission_for_row
from navcore.runtime.lockstep import Tick
from navcore.runtime.replay import replay
from navcore.sim.world import WorldParams
from navcore.transport.codec import decode, encode
from tests.missions.conftest import CONFIG, Drive, new_drive, small_farm

FARM = small_farm()


@pytest.fixture(scope="module")
def run() -> tuple[list[NavInputs], list[Decision]]:
    """Inputs and decisions of a drive into a row, through the encoding that the log uses."""
    drive = new_drive(FARM, WorldParams(seed=5))
    drive.start(FARM, mission_for_row(FARM, "r1", RowExit.REVERSE))
    drive.until_mode(NavMode.ROW)
    drive.until(lambda _: False, seconds=3)
    return _logged(drive)


def _logged(drive: Drive) -> tuple[list[NavInputs], list[Decision]]:
    def again(tick: Tick) -> tuple[NavInputs, Decision]:
        return decode(NavInputs, encode(tick.inputs)), decode(Decision, encode(tick.decision))

    pairs = [again(tick) for tick in drive.ticks]
    return [inputs for inputs, _ in pairs], [decision for _, decision in pairs]


def test_a_recorded_run_replays_to_the_same_decisions(run: tuple[list[NavInputs], list[Decision]]) -> None:
    inputs, decisions = run
    result = replay(CONFIG, FARM.datum, inputs, decisions)
    assert result.difference is None
    assert result.ticks == len(decisions)


def test_other_settings_are_noticed_at_the_first_decision_they_change(
    run: tuple[list[NavInputs], list[Decision]],
) -> None:
    inputs, decisions = run
    slower = RobotConfig(navigator=NavigatorParams(driver=DriverParams(entry=0.3)))
    result = replay(slower, FARM.datum, inputs, decisions)
    assert result.difference is not None
    assert result.ticks > 100


def test_a_lost_input_is_noticed(run: tuple[list[NavInputs], list[Decision]]) -> None:
    inputs, decisions = list(run[0]), run[1]
    k = next(i for i, taken in enumerate(inputs) if i > 500 and taken.imu)
    inputs[k] = replace(inputs[k], imu=())
    assert replay(CONFIG, FARM.datum, inputs, decisions).difference is not None
