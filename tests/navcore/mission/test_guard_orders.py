"""The navigator's words to the guard."""

from __future__ import annotations

from dataclasses import replace

import pytest

from navcore.chassis.protocol import ChassisState, ControlMode, GuardRequest, GuardState, VehicleState
from navcore.geometry.geodesy import EnuFrame
from navcore.localization.attitude import Attitude, AttitudeParams
from navcore.localization.independent_check import IndependentCheck, IndependentCheckParams
from navcore.localization.pose_filter import PoseFilter, PoseFilterParams
from navcore.maps.site_map import Datum
from navcore.messages import RequestKind, RunState
from navcore.mission.driver import Driving
from navcore.mission.evidence import GnssEvidence, GnssEvidenceParams
from navcore.mission.guard_orders import GuardOrders
from navcore.mission.map_evidence import MapEvidence, MapEvidenceParams
from navcore.mission.senses import Senses

MS = 1_000_000
NOW_NS = 5_000 * MS
LONGEST_MS = 200
DRIVING = Driving(v=0.6, omega=-0.1, deadline_ns=NOW_NS + 90 * MS, speed_limit=0.6, speed_reason="mission")
STANDING = ChassisState(
    stamp_ns=NOW_NS, system_stamp_ns=NOW_NS, v=0.0, omega=0.0, left_mm=0, right_mm=0, state=VehicleState.NORMAL,
    mode=ControlMode.CAN, voltage_v=26.0, faults=0, driver_faults=(0, 0, 0, 0), guard=GuardState.ARMED,
    guard_reason="", accepted_seq=1,
)  # fmt: skip


def senses(chassis: ChassisState | None = STANDING, guard: GuardState = GuardState.ARMED) -> Senses:
    """Those of a robot whose chassis says this of itself."""
    frame = EnuFrame(Datum(lat_deg=31.4, lon_deg=120.9, height_m=8.0))
    check = IndependentCheck(frame, IndependentCheckParams())
    made = Senses(
        PoseFilter(frame, PoseFilterParams()), GnssEvidence(GnssEvidenceParams()), Attitude(AttitudeParams()), check,
        MapEvidence(frame, MapEvidenceParams()),
    )  # fmt: skip
    made.chassis = chassis and replace(chassis, guard=guard)
    return made


@pytest.fixture
def orders() -> GuardOrders:
    return GuardOrders(LONGEST_MS)


def test_a_driving_robot_is_told_its_motion_until_its_evidence_is_too_old(orders: GuardOrders) -> None:
    command = orders.command(NOW_NS, RunState.DRIVING, DRIVING, senses())
    assert command is not None
    assert (command.v, command.omega, command.stamp_ns) == (0.6, -0.1, NOW_NS)
    assert command.deadline_ns == DRIVING.deadline_ns


def test_no_evidence_makes_a_command_live_longer_than_the_longest_life(orders: GuardOrders) -> None:
    fresh = replace(DRIVING, deadline_ns=NOW_NS + 10_000 * MS)
    command = orders.command(NOW_NS, RunState.DRIVING, fresh, senses())
    assert command is not None
    assert command.deadline_ns == NOW_NS + LONGEST_MS * MS


@pytest.mark.parametrize("state", [state for state in RunState if state is not RunState.DRIVING])
def test_whoever_is_not_driving_is_told_to_stand(orders: GuardOrders, state: RunState) -> None:
    command = orders.command(NOW_NS, state, DRIVING, senses())
    assert command is not None
    assert (command.v, command.omega) == (0.0, 0.0)
    assert command.deadline_ns == NOW_NS + LONGEST_MS * MS


def test_commands_are_numbered_without_a_gap(orders: GuardOrders) -> None:
    told = [orders.command(NOW_NS, state, DRIVING, senses()) for state in (RunState.DRIVING, RunState.PAUSED)]
    assert [command and command.seq for command in told] == [1, 2]


@pytest.mark.parametrize(
    ("chassis", "guard"),
    [
        (None, GuardState.ARMED),
        (STANDING, GuardState.SILENT),
        (STANDING, GuardState.LATCHED),
        (replace(STANDING, mode=ControlMode.REMOTE), GuardState.ARMED),
    ],
)
def test_nothing_is_said_while_the_guard_does_not_listen(
    orders: GuardOrders, chassis: ChassisState | None, guard: GuardState
) -> None:
    assert orders.command(NOW_NS, RunState.DRIVING, DRIVING, senses(chassis, guard)) is None


def test_a_start_asks_to_arm_until_the_guard_is_armed(orders: GuardOrders) -> None:
    assert orders.request(RunState.STARTING, None, senses(guard=GuardState.SILENT)) is GuardRequest.ARM
    assert orders.request(RunState.STARTING, None, senses()) is None


@pytest.mark.parametrize("state", [RunState.IDLE, RunState.STOPPED, RunState.FINISHED])
def test_a_robot_at_rest_is_disarmed_once_it_stands(orders: GuardOrders, state: RunState) -> None:
    assert orders.request(state, None, senses(replace(STANDING, v=0.3))) is None
    assert orders.request(state, None, senses()) is GuardRequest.DISARM


def test_a_pause_keeps_the_guard_armed(orders: GuardOrders) -> None:
    assert orders.request(RunState.PAUSED, None, senses()) is None


def test_a_latch_is_forgotten_only_when_the_operator_goes_on(orders: GuardOrders) -> None:
    latched = senses(guard=GuardState.LATCHED)
    told = {asked: orders.request(RunState.STOPPED, asked, latched) for asked in (None, *RequestKind)}
    going_on = {asked for asked, request in told.items() if request is GuardRequest.ACKNOWLEDGE}
    assert going_on == {RequestKind.START, RequestKind.RESUME, RequestKind.ACKNOWLEDGE}
