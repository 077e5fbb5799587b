"""The event table: each fault is noticed, speaks, and nothing is on when all is well."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from navcore.chassis.protocol import ChassisState, ControlMode, GuardState, VehicleState
from navcore.messages import (
    CameraMount,
    LidarCondition,
    LinkLossPolicy,
    MapMatch,
    MatchState,
    MountAgreement,
    NavMode,
    RunState,
)
from navcore.mission.events.event import effects_of
from navcore.mission.events.facts import EventFacts, EventParams
from navcore.mission.events.table import EVENTS, active_events
from navcore.mission.state_machine import Effect

PARAMS = EventParams()
CHASSIS = ChassisState(
    stamp_ns=0, system_stamp_ns=0, v=0.5, omega=0.0, left_mm=0, right_mm=0, state=VehicleState.NORMAL,
    mode=ControlMode.CAN, voltage_v=26.0, faults=0, driver_faults=(0, 0, 0, 0), guard=GuardState.ARMED,
    guard_reason="", accepted_seq=1,
)  # fmt: skip
MOUNT = CameraMount(pitch=0.01, pitch_std=0.005, height=0.82, height_std=0.03, told_height=0.8)
LIDAR = LidarCondition(points=20_000, roll=0.01, pitch=-0.01, air=0.05)
MATCH = MapMatch(stamp_ns=0, state=MatchState.MATCHED, passed=40, gone=2, lidar=LIDAR)
WELL = EventFacts(
    state=RunState.DRIVING, mode=NavMode.GNSS_PATH, tick_s=0.02, chassis=CHASSIS, chassis_age_s=0.02,
    system_age_s=0.05, pose_std=0.02, carried=0.0, gnss_age_s=0.2, pose_cap=None, pose_cap_reason="",
    pose_cap_passes=False, row_age_s=None, row_reason="", entrance=None, room=None, lateral_error=0.02,
    captured=True, stuck=False, held_s=0.0, arming_s=0.0, link_age_s=0.5, link_loss=LinkLossPolicy.STOP, zone="",
    start_distance=0.1, waiting_for_gnss=False, askew=(0.01, 0.01), mount=MOUNT, map_match=MATCH,
)  # fmt: skip


def lidar3d(**condition: Any) -> dict[str, Any]:
    """Facts of a 3D LiDAR that does not do well."""
    return {"map_match": replace(MATCH, lidar=replace(LIDAR, **condition))}


FAULTS: dict[str, dict[str, Any]] = {
    "lidar3d_empty": lidar3d(points=20),
    "lidar3d_leans": lidar3d(roll=-math.radians(5.0)),
    "lidar3d_turned": {"lidar3d_turned": math.radians(5.0)},
    "lidar3d_drops": lidar3d(air=0.13),
    "map_outdated": {"map_match": replace(MATCH, gone=9)},
    "chassis_silent": {"chassis_age_s": 0.25},
    "emergency_stop": {"chassis": replace(CHASSIS, state=VehicleState.EMERGENCY_STOP)},
    "chassis_fault": {"chassis": replace(CHASSIS, driver_faults=(0, 4, 0, 0))},
    "remote_control": {"chassis": replace(CHASSIS, mode=ControlMode.REMOTE)},
    "chassis_left_can": {"chassis": replace(CHASSIS, mode=ControlMode.STANDBY)},
    "guard_latched": {"chassis": replace(CHASSIS, guard=GuardState.LATCHED, guard_reason="silence")},
    "not_arming": {"state": RunState.STARTING, "arming_s": 6.0},
    "battery_empty": {"chassis": replace(CHASSIS, voltage_v=21.5)},
    "battery_low": {"chassis": replace(CHASSIS, voltage_v=23.0)},
    "tick_late": {"tick_s": 0.25},
    "camera_askew": {"askew": (0.1, 0.02)},
    "camera_pitched": {"mount": replace(MOUNT, pitch=-0.06)},
    "camera_raised": {"mount": replace(MOUNT, height=1.05)},
    "camera_turned": {"agreement": MountAgreement(trunks=20, yaw=0.03, yaw_std=0.005, moved=True)},
    "tick_slow": {"tick_s": 0.12},
    "no_position": {"pose_std": None},
    "position_unsure": {"pose_std": 1.0},
    "gnss_old": {"gnss_age_s": 1.5},
    "gnss_lost": {"gnss_age_s": 3.5},
    "pose_in_doubt": {"pose_cap": 0.0, "pose_cap_reason": "the receiver has jumped"},
    "pose_apart": {"pose_cap": 0.0, "pose_cap_reason": "2.1 m apart", "pose_cap_passes": True},
    "pose_weak": {"pose_cap": 0.3, "pose_cap_reason": "GNSS is only float"},
    "waiting_for_gnss": {"waiting_for_gnss": True},
    "entrance_unseen": {"entrance": 0.9},
    "beside_entrance": {"mode": NavMode.ROW_ENTRY, "room": 0.05},
    "row_unseen": {"mode": NavMode.ROW, "row_age_s": 0.6},
    "carried_too_far": {"mode": NavMode.HEADLAND, "carried": 31.0},
    "map_unsure": {"mode": NavMode.MAP, "map_age_s": 0.9},
    "map_disputed": {"map_disputed": True, "map_reason": "RTK and the 3D map are 0.6 m apart"},
    "place_unknown": {
        "state": RunState.IDLE,
        "pose_std": None,
        "map_in_use": True,
        "map_reason": "2 places look the same",
    },
    "held_too_long": {"state": RunState.HOLDING, "held_s": 21.0},
    "off_path": {"lateral_error": -0.35},
    "far_off_path": {"lateral_error": 0.6},
    "no_progress": {"stuck": True},
    "zone": {"zone": "A keep-out zone is ahead."},
    "link_lost": {"link_age_s": 6.0},
    "halt": {"state": RunState.PAUSED, "halt": "At row 7, left trunk 30 of 52. Resume to go on."},
    "not_at_start": {"start_distance": 12.0},
}


def names(facts: EventFacts) -> set[str]:
    return {event.name for event in active_events(facts, PARAMS)}


def test_nothing_is_on_when_all_is_well() -> None:
    assert names(WELL) == set()


def test_every_event_of_the_table_has_its_fault_here() -> None:
    assert {event.name for event in EVENTS} == set(FAULTS)


@pytest.mark.parametrize("name", FAULTS)
def test_each_fault_is_noticed_and_says_what_to_do(name: str) -> None:
    facts = replace(WELL, **FAULTS[name])
    event = next(e for e in EVENTS if e.name == name)
    assert name in names(facts)
    assert event.text(facts).endswith(".")
    assert event.effects


@pytest.mark.parametrize(
    "field", ["lateral_error", "pose_std", "tick_s", "chassis_age_s", "gnss_age_s", "link_age_s"]
)
def test_a_nan_is_never_well(field: str) -> None:
    change: dict[str, Any] = {field: math.nan}
    facts = replace(WELL, **change)
    assert effects_of(active_events(facts, PARAMS)) & {Effect.STOP, Effect.NO_ENTRY}


def test_a_stamp_from_the_future_is_old() -> None:
    assert "gnss_lost" in names(replace(WELL, gnss_age_s=-0.5))


def test_gnss_may_be_silent_while_the_camera_is_driven_on() -> None:
    in_row = replace(WELL, mode=NavMode.ROW, row_age_s=0.1, gnss_age_s=30.0, pose_std=5.0)
    assert Effect.STOP not in effects_of(active_events(in_row, PARAMS))


@pytest.mark.parametrize(
    ("state", "mode", "doubted"),
    [
        (RunState.STOPPED, NavMode.ROW, False), (RunState.STOPPED, NavMode.HEADLAND, False),
        (RunState.STOPPED, NavMode.GNSS_PATH, True), (RunState.IDLE, NavMode.IDLE, True),
        (RunState.FINISHED, NavMode.ROW, True),
    ],
)  # fmt: skip
def test_a_vague_position_keeps_from_setting_off_only_where_gnss_is_driven_on(
    state: RunState, mode: NavMode, doubted: bool
) -> None:
    facts = replace(WELL, state=state, mode=mode, pose_std=1.0, row_age_s=0.1)
    assert ("position_unsure" in [event.name for event in active_events(facts, PARAMS)]) is doubted


def test_a_robot_that_drives_on_the_3d_map_waits_as_soon_as_others_contradict_it() -> None:
    on_map = replace(WELL, mode=NavMode.MAP, map_age_s=0.1, gnss_age_s=30.0)
    assert names(on_map) == set()
    disputed = replace(on_map, map_disputed=True, map_reason="the 3D map's place jumped 0.5 m against the wheels")
    assert names(disputed) == {"map_unsure"}
    assert names(replace(on_map, pose_std=0.3)) == {"map_unsure"}
    assert names(replace(on_map, map_age_s=math.nan)) == {"map_unsure"}


@pytest.mark.parametrize(
    ("condition", "words"),
    [
        ({"roll": -math.radians(5.0)}, "leans 5 degrees to the right"),
        ({"roll": math.radians(5.0)}, "leans 5 degrees to the left"),
        ({"pitch": -math.radians(4.0)}, "leans 4 degrees to the front"),
        ({"pitch": math.radians(4.0)}, "leans 4 degrees to the back"),
    ],
)
def test_a_leaning_3d_lidar_is_told_with_its_side(condition: dict[str, float], words: str) -> None:
    events = active_events(replace(WELL, **lidar3d(**condition)), PARAMS)
    assert [words in event.text(replace(WELL, **lidar3d(**condition))) for event in events] == [True]


def test_a_few_uprights_that_are_gone_make_no_map_old() -> None:
    assert not active_events(replace(WELL, map_match=replace(MATCH, passed=8, gone=3)), PARAMS)
