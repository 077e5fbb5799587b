"""Told roughly where it stands, or nothing, the robot finds its place on the map or says why not."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.geometry.se2 import SE2
from navcore.geometry.se3 import SE3
from navcore.localization.lidar3d.map_localizer import MapLocalizer
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.messages import FixQuality, MapMatch, MatchState, Odometry, PoseEstimate
from tests.navcore.localization.ndt.trellis import mapped_orchard, scan_at
from tests.navcore.localization.regular_block import mapped_block, scan_in_block

TURN_NS = 100_000_000
TOLD_STD, TOLD_YAW_STD = 0.5, math.radians(10.0)
HERE = SE2(1.3, -0.2, 0.05)


@pytest.fixture(scope="module")
def orchard_map() -> NdtMap:
    """Posts 8 cm about their spots: no two places are alike."""
    return mapped_orchard()


@pytest.fixture(scope="module")
def block_map() -> NdtMap:
    """Every row and every post like the next one."""
    return mapped_block()


def pose(at: SE2, std: float, yaw_std: float) -> PoseEstimate:
    covariance = (std**2, 0.0, 0.0, 0.0, std**2, 0.0, 0.0, 0.0, yaw_std**2)
    return PoseEstimate(
        stamp_ns=0, x=at.x, y=at.y, yaw=at.yaw, v=0.0, omega=0.0, covariance=covariance, source="told"
    )


def motion(
    at: SE2 = SE2(), told: SE2 | None = None, told_ns: int = 1, known: PoseEstimate | None = None,
    quality: FixQuality = FixQuality.NONE,
) -> Odometry:  # fmt: skip
    """Of a level robot; `at` is its place in `odom`."""
    place = None if told is None else pose(told, TOLD_STD, TOLD_YAW_STD)
    return Odometry(
        stamp_ns=0, x=at.x, y=at.y, yaw=at.yaw, v=0.0, omega=0.0, roll=0.0, pitch=0.0, pose=known, quality=quality,
        told=place, told_ns=told_ns if told is not None else 0,
    )  # fmt: skip


def scan(at: SE2, seed: int) -> np.ndarray:
    return scan_at(SE3.from_rpy((at.x, at.y, 0.0), 0.0, 0.0, at.yaw), seed, n=16_000)


def standing(localizer: MapLocalizer, told: SE2 | None, clouds: int = 40, told_ns: int = 1) -> list[MapMatch]:
    """Until there is a place, for at most so many clouds."""
    found: list[MapMatch] = []
    while len(found) < clouds and (not found or found[-1].state is not MatchState.MATCHED):
        k = len(found)
        found.append(localizer.process(scan(HERE, k), k * TURN_NS, motion(told=told, told_ns=told_ns)))
    return found


def off(match: MapMatch, at: SE2) -> tuple[float, float]:
    return math.dist((match.x, match.y), (at.x, at.y)), abs(math.remainder(match.yaw - at.yaw, 2.0 * math.pi))


@pytest.mark.parametrize(
    ("dx", "dy", "turn_deg"), [(1.4, 0.0, 29.0), (-1.0, 1.0, -29.0), (0.0, -1.4, 10.0), (0.5, 0.5, 0.0)]
)
def test_told_to_a_metre_and_a_half_and_thirty_degrees_it_finds_its_place(
    orchard_map: NdtMap, dx: float, dy: float, turn_deg: float
) -> None:
    told = SE2(HERE.x + dx, HERE.y + dy, HERE.yaw + math.radians(turn_deg))
    found = standing(MapLocalizer(orchard_map), told)
    assert found[-1].state is MatchState.MATCHED, found[-1].reason
    assert len(found) <= 20  # clouds, of which ten come in a second
    away, turned = off(found[-1], HERE)
    assert away < 0.05  # m
    assert turned < 0.01  # rad


def test_told_nothing_it_finds_a_place_that_no_other_is_like(orchard_map: NdtMap) -> None:
    found = standing(MapLocalizer(orchard_map), None)
    assert found[-1].state is MatchState.MATCHED, found[-1].reason
    assert off(found[-1], HERE)[0] < 0.05  # m


def test_told_nothing_in_a_block_that_repeats_itself_it_says_how_many_places_look_the_same(block_map: NdtMap) -> None:
    localizer = MapLocalizer(block_map)
    found = [localizer.process(scan_in_block(HERE, k), k * TURN_NS, motion()) for k in range(40)]
    assert all(match.state is not MatchState.MATCHED for match in found)
    assert found[-1].state is MatchState.AMBIGUOUS
    assert found[-1].alike >= 2
    assert f"{found[-1].alike} places look the same: say where the robot stands" in found[-1].reason


def test_a_word_ends_the_ambiguity(block_map: NdtMap) -> None:
    localizer = MapLocalizer(block_map)
    for k in range(40):
        localizer.process(scan_in_block(HERE, k), k * TURN_NS, motion())
    told = SE2(HERE.x + 0.3, HERE.y - 0.3, HERE.yaw + 0.2)
    found = [localizer.process(scan_in_block(HERE, k), k * TURN_NS, motion(told=told)) for k in range(40, 70)]
    assert found[-1].state is MatchState.MATCHED, found[-1].reason
    assert off(found[-1], HERE)[0] < 0.05  # m


def test_a_place_off_the_map_is_no_place(orchard_map: NdtMap) -> None:
    found = standing(MapLocalizer(orchard_map), SE2(500.0, 0.0, 0.0), clouds=15)
    assert found[-1].state is MatchState.STARTING
    assert "fits nowhere on the 3D map near there" in found[-1].reason


def test_who_takes_one_row_for_the_next_is_told_so(orchard_map: NdtMap) -> None:
    found = standing(MapLocalizer(orchard_map), SE2(HERE.x, HERE.y + 6.0, HERE.yaw), clouds=20)
    assert found[-1].state is MatchState.STARTING
    assert "fits better 6 m from there" in found[-1].reason


def test_a_new_word_ends_what_was_believed(orchard_map: NdtMap) -> None:
    localizer = MapLocalizer(orchard_map)
    assert standing(localizer, HERE)[-1].state is MatchState.MATCHED
    again = localizer.process(scan(HERE, 99), 10**11, motion(told=HERE, told_ns=2))
    assert again.state is not MatchState.MATCHED
    assert standing(localizer, HERE, told_ns=2)[-1].state is MatchState.MATCHED


def test_creeping_on_does_not_lose_what_was_told(orchard_map: NdtMap) -> None:
    localizer, told = MapLocalizer(orchard_map), SE2(HERE.x - 0.9, HERE.y + 0.8, HERE.yaw + 0.3)
    match = MapMatch(stamp_ns=0, state=MatchState.STARTING)
    for k in range(20):
        moved = SE2(0.03 * k, 0.0, 0.0)
        match = localizer.process(scan(HERE @ moved, k), k * TURN_NS, motion(moved, told @ moved))
    assert match.state is MatchState.MATCHED, match.reason
    assert off(match, HERE @ SE2(0.57, 0.0, 0.0))[0] < 0.05  # m


def test_rtk_that_holds_the_robot_elsewhere_ends_a_place_that_was_found_alone(orchard_map: NdtMap) -> None:
    localizer = MapLocalizer(orchard_map)
    standing(localizer, HERE)
    elsewhere = pose(SE2(HERE.x + 3.0, HERE.y, HERE.yaw), 0.02, 0.01)
    states = [
        localizer.process(
            scan(HERE, 100 + k), 10**11 + k * TURN_NS, motion(known=elsewhere, quality=FixQuality.RTK_FIXED)
        ).state
        for k in range(25)
    ]
    assert states[0] is MatchState.MATCHED  # one moment is no proof
    assert states[-1] is not MatchState.MATCHED


def test_a_guess_without_rtk_does_not_overrule_the_map(orchard_map: NdtMap) -> None:
    localizer = MapLocalizer(orchard_map)
    standing(localizer, HERE)
    guess = pose(SE2(HERE.x + 3.0, HERE.y, HERE.yaw), 2.0, 0.1)
    for k in range(25):
        match = localizer.process(scan(HERE, 100 + k), 10**11 + k * TURN_NS, motion(known=guess))
    assert match.state is MatchState.MATCHED


def test_the_same_clouds_lead_to_the_same_place(orchard_map: NdtMap) -> None:
    told = SE2(HERE.x + 1.0, HERE.y - 0.7, HERE.yaw - 0.4)
    once, again = (standing(MapLocalizer(orchard_map), told)[-1] for _ in range(2))
    assert once == replace(again)


def test_an_empty_map_says_what_to_do() -> None:
    match = MapLocalizer(NdtMap()).process(scan(HERE, 0), 0, motion())
    assert "make one from a run" in match.reason
