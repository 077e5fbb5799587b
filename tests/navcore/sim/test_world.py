"""The world runs, tells the truth only as truth, and repeats itself bit for bit."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.errors import ContractError, InputError, NotFiniteError
from navcore.maps.site_map import SiteMap
from navcore.sim.contacts import ContactKind
from navcore.sim.lidar2d import Lidar2dFaults, Lidar2dParams
from navcore.sim.map_error import NO_MAP_ERROR
from navcore.sim.world import World, WorldFaults, WorldOutput, WorldParams
from navcore.vehicle import PAPER_A

TICK_NS = 20_000_000


def run(world: World, seconds: float, v: float, omega: float = 0.0, start_s: float = 0.0) -> list[WorldOutput]:
    first = round(start_s / 0.02)
    return [world.advance((first + k) * TICK_NS, v, omega) for k in range(1, round(seconds / 0.02) + 1)]


def world(farm: SiteMap, **params: object) -> World:
    return World(farm, PAPER_A, WorldParams(**params))  # type: ignore[arg-type]


def test_the_same_seed_gives_the_same_bits(farm: SiteMap) -> None:
    assert run(world(farm), 10.0, 0.8, 0.1) == run(world(farm), 10.0, 0.8, 0.1)


def test_another_seed_gives_another_world(farm: SiteMap) -> None:
    a, b = run(world(farm), 2.0, 0.8), run(world(farm, seed=2), 2.0, 0.8)
    assert a[-1].truth != b[-1].truth


def test_the_step_of_the_caller_does_not_change_the_world(farm: SiteMap) -> None:
    often, seldom = world(farm), world(farm)
    fine = [often.advance(k * 5_000_000, 0.6, 0.1) for k in range(1, 801)]
    coarse = [seldom.advance(k * 100_000_000, 0.6, 0.1) for k in range(1, 41)]
    assert fine[-1].truth == coarse[-1].truth
    assert [s for o in fine for s in o.imu] == [s for o in coarse for s in o.imu]
    assert b"".join(o.nmea for o in fine) == b"".join(o.nmea for o in coarse)


def test_the_imu_samples_a_hundred_times_a_second_and_arrives_late(farm: SiteMap) -> None:
    outputs = run(world(farm), 2.0, 0.5)
    stamps = [s.stamp_ns for o in outputs for s in o.imu]
    assert set(np.diff(stamps)) == {10_000_000}
    assert all(o.truth.stamp_ns - s.stamp_ns >= 8_000_000 for o in outputs for s in o.imu)


def test_the_imu_shakes_with_speed_and_feels_gravity(farm: SiteMap) -> None:
    still, moving = run(world(farm), 5.0, 0.0), run(world(farm), 5.0, 1.0)
    rates = [np.std([s.wx for o in outputs for s in o.imu]) for outputs in (still, moving)]
    assert rates[1] > 3.0 * rates[0]
    assert np.mean([s.az for o in still for s in o.imu]) == pytest.approx(9.8, abs=0.3)
    tilt = np.mean([o.truth.pitch for o in still])
    assert np.mean([s.ax for o in still for s in o.imu]) == pytest.approx(-9.8 * math.sin(tilt), abs=0.3)


def test_the_gyro_is_biased(farm: SiteMap) -> None:
    biases = [np.mean([s.wz for o in run(world(farm, seed=k), 3.0, 0.0) for s in o.imu]) for k in range(4)]
    assert 2e-4 < np.max(np.abs(biases)) < 0.01


def test_gnss_arrives_five_times_a_second(farm: SiteMap) -> None:
    text = b"".join(o.nmea for o in run(world(farm), 10.0, 0.0))
    assert 46 <= text.count(b"GNGGA") <= 50


def test_the_robot_is_not_parked_quite_as_drawn(farm: SiteMap) -> None:
    errors = []
    for seed in range(1, 6):
        truth = world(farm, seed=seed, map_error=NO_MAP_ERROR).advance(0, 0.0, 0.0).truth
        errors.append(math.hypot(truth.x, truth.y))
    assert 0.05 < max(errors) < 0.6


def test_touching_a_post_is_told_once(farm: SiteMap) -> None:
    robot = world(farm, start=(12.0, 36.0, 0.0), map_error=NO_MAP_ERROR)
    touched = [c for o in run(robot, 15.0, 0.6) for c in o.contacts]
    assert {c.kind for c in touched} <= {ContactKind.POST, ContactKind.TRUNK}
    assert touched
    assert len({(c.kind, c.x, c.y) for c in touched}) == len(touched)


def test_the_warehouse_and_keep_out_zones_are_felt(farm: SiteMap) -> None:
    backwards = world(farm, start=(-2.0, 0.0, 0.0), map_error=NO_MAP_ERROR)
    assert ContactKind.BUILDING in {c.kind for o in run(backwards, 8.0, -0.6) for c in o.contacts}
    pond = world(farm, start=(48.0, 10.0, 0.0), map_error=NO_MAP_ERROR)
    assert [c.kind for o in run(pond, 8.0, 0.6) for c in o.contacts] == [ContactKind.KEEP_OUT]


def test_the_middle_of_a_row_touches_nothing(farm: SiteMap) -> None:
    robot = world(farm, start=(23.0, 20.0, math.pi / 2), map_error=NO_MAP_ERROR)
    assert not [c for o in run(robot, 4.0, 0.6) for c in o.contacts]


def test_faults_break_what_they_say(farm: SiteMap) -> None:
    robot = world(farm)
    robot.faults = WorldFaults(gnss_silent=True, imu_silent=True, stuck=True)
    outputs = run(robot, 5.0, 0.8)
    assert b"".join(o.nmea for o in outputs) == b""
    assert not any(o.imu for o in outputs)
    assert outputs[-1].truth.x == outputs[0].truth.x
    assert outputs[-1].wheels.left_m > 2.0


def test_a_frozen_receiver_sends_fresh_times_with_an_old_place(farm: SiteMap) -> None:
    robot = world(farm)
    run(robot, 2.0, 0.8)
    robot.faults = WorldFaults(gnss_frozen=True)
    text = b"".join(o.nmea for o in run(robot, 4.0, 0.8, start_s=2.0))
    gga = [line.split(b",") for line in text.split(b"\r\n") if line.startswith(b"$GNGGA")][3:]
    assert len({line[1] for line in gga}) == len(gga) > 10
    assert len({line[2] for line in gga}) == 1


def test_a_runaway_chassis_drives_more_than_told(farm: SiteMap) -> None:
    robot = world(farm)
    robot.faults = replace(WorldFaults(), drive_gain=2.0)
    assert run(robot, 5.0, 0.4)[-1].wheels.v == pytest.approx(0.8, abs=0.01)


def test_nan_targets_and_time_running_backwards_are_refused(farm: SiteMap) -> None:
    robot = world(farm)
    with pytest.raises(NotFiniteError):
        robot.advance(TICK_NS, math.nan, 0.0)
    robot.advance(TICK_NS, 0.0, 0.0)
    with pytest.raises(ContractError):
        robot.advance(0, 0.0, 0.0)


def test_a_site_without_a_warehouse_says_what_to_do(farm: SiteMap) -> None:
    with pytest.raises(InputError, match="Draw the warehouse"):
        World(replace(farm, warehouse=None), PAPER_A, WorldParams())


def test_lost_corrections_cost_the_fix_after_a_while(farm: SiteMap) -> None:
    robot = world(farm)
    robot.faults = WorldFaults(corrections_lost=True)
    text = b"".join(o.nmea for o in run(robot, 30.0, 0.0))
    qualities = [line.split(b",")[6] for line in text.split(b"\r\n") if line.startswith(b"$GNGGA") and b"*" in line]
    assert (qualities[0], qualities[-1]) == (b"4", b"5")


def test_the_world_tells_its_true_rows_for_the_score(farm: SiteMap) -> None:
    robot = world(farm)
    assert [row.id for row in robot.farm().rows] == [row.id for row in farm.rows]
    assert robot.farm().rows[0].start == robot.site.rows[0].start != farm.rows[0].start


def test_a_robot_with_a_lidar_hands_out_ten_turns_a_second_and_changes_nothing_else(farm: SiteMap) -> None:
    without, with_lidar = run(world(farm), 2.0, 0.6), run(world(farm, lidar2d=Lidar2dParams()), 2.0, 0.6)
    assert [replace(o, scans=(), scan_owners=()) for o in with_lidar] == without
    assert not any(o.scans for o in without)
    late = [o.truth.stamp_ns - s.stamp_ns for o in with_lidar for s in o.scans]
    assert len(late) == 19
    assert all(20_000_000 <= ns <= 40_000_000 for ns in late)
    assert all(len(s.distances) == len(w) for o in with_lidar for s, w in zip(o.scans, o.scan_owners, strict=True))


def test_the_lidars_turns_do_not_depend_on_the_step_of_the_caller(farm: SiteMap) -> None:
    often, seldom = (world(farm, lidar2d=Lidar2dParams()) for _ in range(2))
    fine = [often.advance(k * 5_000_000, 0.6, 0.1) for k in range(1, 101)]
    coarse = [seldom.advance(k * 100_000_000, 0.6, 0.1) for k in range(1, 6)]
    assert [s for o in fine for s in o.scans] == [s for o in coarse for s in o.scans] != []


def test_a_broken_lidar_breaks_only_itself(farm: SiteMap) -> None:
    robot = world(farm, lidar2d=Lidar2dParams())
    run(robot, 0.5, 0.6)
    robot.faults = WorldFaults(lidar=Lidar2dFaults(silent=True))
    outputs = run(robot, 1.0, 0.6, start_s=0.5)
    assert not [s for o in outputs[10:] for s in o.scans]
    assert b"".join(o.nmea for o in outputs)
    robot.faults = WorldFaults()
    assert [s for o in run(robot, 0.5, 0.6, start_s=1.5) for s in o.scans]
