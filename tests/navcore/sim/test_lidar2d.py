"""The simulated LiDAR as a device: late, noisy and faulty as told, and the same bits for the same seed."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.errors import ContractError, InputError, NotFiniteError
from navcore.geometry.lidar_mount import robot_lidar
from navcore.sim.lidar2d import FLAWLESS, WORKING, Lidar2d, Lidar2dFaults, Lidar2dParams, SimScan
from navcore.sim.trunk_sections import trunk_sections
from tests.navcore.sim.lidar2d_turns import (
    REAL,
    at,
    ends,
    lone_tree,
    shed_behind,
    still,
    turns,
)


def test_the_turn_is_clockwise_and_even_in_time() -> None:
    first, second = (turn.scan for turn in turns(shed_behind(), FLAWLESS, 2))
    assert np.diff(first.angles) == pytest.approx(np.full(1599, -math.radians(0.225)), abs=1.1e-5)  # rad, as rounded
    assert (first.began_ns, first.stamp_ns) == (0, 99_937_500)
    assert second.began_ns == 100_000_000
    assert first.distances == second.distances, "a robot that stands still sees the same again"


def test_a_turn_arrives_late_and_once() -> None:
    lidar = Lidar2d(shed_behind(), robot_lidar(), replace(REAL, latency_s=0.03), np.random.default_rng(1))
    for k in range(21):
        lidar.update(still(k))
    assert lidar.due(129_000_000) == ()
    assert len(lidar.due(130_000_000)) == 1
    assert lidar.due(130_000_000) == ()


def test_the_same_seed_gives_the_same_bits_however_often_the_pose_is_told() -> None:
    often = turns(shed_behind(), REAL, 3)
    lidar = Lidar2d(shed_behind(), robot_lidar(), REAL, np.random.default_rng(1))
    for k in range(0, 61, 4):
        lidar.update(still(k))
    assert often == list(lidar.due(10**15))
    assert often[0] != turns(shed_behind(), REAL, 1, seed=2)[0]


def test_noise_is_white_about_a_scale_that_is_each_devices_own() -> None:
    true = np.array(turns(shed_behind(), FLAWLESS)[0].scan.distances)
    near = (true > 0.0) & (true < 4.0)
    scales = []
    for seed in range(12):
        shares = []
        for turn in turns(shed_behind(), REAL, 2, seed=seed):
            d = np.array(turn.scan.distances)
            seen = near & (d > 0.0)
            shares.append((d / np.where(near, true, 1.0))[seen])
        assert np.std(shares[0]) == pytest.approx(0.004, rel=0.35)  # share of the distance
        assert np.mean(shares[0]) == pytest.approx(np.mean(shares[1]), abs=0.001)
        scales.append(np.mean(shares[0]) - 1.0)
    assert 0.004 < np.std(scales) < 0.016


def test_grazing_rays_and_far_bark_are_lost_first() -> None:
    true = np.array(turns(shed_behind(), FLAWLESS)[0].scan.distances)
    back = np.mean([np.array(t.scan.distances) > 0.0 for t in turns(shed_behind(), REAL, 10)], axis=0)
    square, grazing = (true > 0.0) & (true < 3.2), true > 5.5
    assert back[square].mean() > 0.98
    assert back[grazing].mean() < back[square].mean() - 0.03
    near, far = lone_tree(2.0, 0.0), lone_tree(11.0, 0.0)
    shares = []
    for tree in (near, far):
        there = np.array(turns(tree, FLAWLESS)[0].scan.distances) > 0.0
        shares.append(np.mean([np.array(t.scan.distances)[there] > 0.0 for t in turns(tree, REAL, 10)]))
    assert shares[0] > 0.9
    assert shares[1] < 0.6


def test_faults_break_what_they_say_at_any_instant() -> None:
    wall = shed_behind()
    lidar = Lidar2d(wall, robot_lidar(), REAL, np.random.default_rng(1))
    told: dict[str, list[SimScan]] = {}
    order = {
        "well": WORKING, "silent": Lidar2dFaults(silent=True), "zeros": Lidar2dFaults(zeros=True),
        "sun": Lidar2dFaults(sun=(math.pi, 0.3)), "well again": WORKING,
    }  # fmt: skip
    lidar.update(still(0))
    for i, (name, faults) in enumerate(order.items()):
        for k in range(40 * i + 1, 40 * i + 41):
            lidar.update(still(k), faults)
        told[name] = list(lidar.due(10**15))
    assert [len(scans) for scans in told.values()] == [2, 0, 2, 2, 2]
    assert set(told["zeros"][0].scan.distances) == {0.0}
    well, sun, again = (np.array(told[n][1].scan.distances) > 0.0 for n in ("well", "sun", "well again"))
    glare = np.abs(np.array(told["sun"][0].scan.angles) + math.pi) < 0.29
    assert well[glare].mean() > 0.95
    assert 0.0 < sun[glare].mean() < 0.15
    assert sun[~glare].sum() == pytest.approx(well[~glare].sum(), rel=0.1)
    assert again[glare].mean() > 0.95


def test_an_overturned_sensor_sees_left_and_right_exchanged() -> None:
    tree = lone_tree(2.0, 1.0)
    x, y, _ = trunk_sections(tree, robot_lidar().z)[0]
    (turn,) = turns(tree, FLAWLESS, faults=Lidar2dFaults(turned=(math.pi, 0.0, 0.0)))
    assert ends(turn.scan).mean(axis=0)[:2] == pytest.approx((x, -y), abs=0.1)  # m


def test_a_broken_pose_and_time_running_backwards_are_refused() -> None:
    lidar = Lidar2d(shed_behind(), robot_lidar(), REAL, np.random.default_rng(1))
    with pytest.raises(NotFiniteError):
        lidar.update(at(1, roll=math.nan))
    lidar.update(still(2))
    with pytest.raises(ContractError, match="backwards"):
        lidar.update(still(1))


@pytest.mark.parametrize("value", [math.nan, 4.0, 16.0])
def test_an_impossible_turn_rate_is_refused(value: float) -> None:
    with pytest.raises(InputError, match="turns_per_s"):
        Lidar2dParams(turns_per_s=value)


def test_fifteen_turns_a_second_have_coarser_angles() -> None:
    scans = turns(shed_behind(), replace(FLAWLESS, turns_per_s=15.0), 2)
    assert len(scans) == 3
    assert len(scans[0].scan.angles) == 1067
