"""A mount that was moved raises an alarm, one that was not does not, and wrong pairs change neither."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.calibration.mount_check import MountCheck, MountCheckParams, MountState, TrunkPair
from navcore.errors import InputError, NotFiniteError

# 1-sigma of each sensor's bearing of a trunk: 3 px of a camera, 1 cm at 2 m of a LiDAR.
STD = math.radians(0.3)
PARAMS = MountCheckParams()
GOOD = TrunkPair(camera_bearing=0.1, camera_std=STD, lidar_bearing=0.1, lidar_std=STD, distance=2.0)


def pair(rng: np.random.Generator, yaw: float, lateral: float, wrong: float) -> TrunkPair:
    """A trunk seen by a camera that is turned and moved to the left by so much, rad and m."""
    x, y = rng.uniform(1.0, 4.0), rng.choice((-1.0, 1.0)) * rng.uniform(0.9, 1.4)
    where, seen = math.atan2(y, x), math.atan2(y - lateral, x) - yaw
    if rng.random() < wrong:
        seen = where + math.radians(rng.uniform(-12.0, 12.0))
    return TrunkPair(
        camera_bearing=seen + STD * rng.standard_normal(), camera_std=STD,
        lidar_bearing=where + STD * rng.standard_normal(), lidar_std=STD, distance=math.hypot(x, y),
    )  # fmt: skip


def checked(seed: int, *, yaw_deg: float = 0.0, lateral: float = 0.0, pairs: int = 100) -> list[MountState]:
    rng, check = np.random.default_rng(seed), MountCheck(PARAMS)
    return [check.add(pair(rng, math.radians(yaw_deg), lateral, 0.1)) for _ in range(pairs)]


def test_a_mount_turned_by_a_degree_is_noticed_within_a_hundred_trunks() -> None:
    for seed in range(12):
        assert checked(seed, yaw_deg=1.0 if seed % 2 else -1.0)[-1].moved, seed


def test_a_mount_within_its_calibration_raises_no_alarm() -> None:
    rng = np.random.default_rng(1)
    for seed in range(25):
        yaw_deg, lateral = rng.normal(0.0, PARAMS.yaw_std_deg), rng.normal(0.0, PARAMS.lateral_std)
        assert not checked(100 + seed, yaw_deg=float(yaw_deg), lateral=float(lateral))[-1].moved, seed


def test_the_running_estimate_holds_the_truth_within_its_sigma() -> None:
    off = []
    for seed in range(12):
        state = checked(200 + seed, yaw_deg=2.0)[-1]
        off.append((state.yaw - math.radians(2.0)) / state.yaw_std)
        assert state.yaw_std < math.radians(0.3)
    assert np.sqrt(np.mean(np.square(off))) < 1.6  # sigmas


def test_a_camera_moved_aside_is_told_from_one_that_is_turned() -> None:
    state = checked(5, lateral=0.06, pairs=200)[-1]
    assert state.moved
    assert state.lateral == pytest.approx(0.06, abs=0.03)  # m
    assert state.yaw == pytest.approx(0.0, abs=math.radians(0.6))


def test_trunks_all_as_far_away_do_not_tell_a_lateral_shift() -> None:
    rng, check = np.random.default_rng(3), MountCheck(PARAMS)
    for _ in range(50):
        noise = STD * rng.standard_normal(2)
        state = check.add(
            replace(GOOD, camera_bearing=noise[0], lidar_bearing=noise[1], distance=4.0)
        )  # fmt: skip
    assert state.lateral is None
    assert state.lateral_std is None


def test_the_alarm_stays_and_says_by_how_much() -> None:
    states = checked(4, yaw_deg=3.0)
    first = next(k for k, state in enumerate(states) if state.moved)
    assert first < 25
    assert all(state.moved for state in states[first:])
    assert states[-1].yaw == pytest.approx(math.radians(3.0), abs=math.radians(0.2))


def test_nothing_is_claimed_before_the_first_trunk() -> None:
    state = MountCheck(PARAMS).state()
    assert (state.pairs, state.moved, state.lateral) == (0, False, None)


@pytest.mark.parametrize("field", ["camera_bearing", "camera_std", "lidar_bearing", "lidar_std", "distance"])
def test_nan_is_refused(field: str) -> None:
    with pytest.raises(NotFiniteError):
        MountCheck(PARAMS).add(replace(GOOD, **{field: math.nan}))


@pytest.mark.parametrize(("field", "value"), [("camera_std", -1.0), ("distance", 0.0)])
def test_a_pair_that_cannot_be_is_refused(field: str, value: float) -> None:
    with pytest.raises(InputError, match="sigmas of 0 or more"):
        MountCheck(PARAMS).add(replace(GOOD, **{field: value}))
