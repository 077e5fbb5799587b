"""Scan after scan the last descent does, and all of them where it does not."""

from __future__ import annotations

import math

import numpy as np

from navcore.geometry.se3 import SE3
from navcore.localization.ndt.scan_follower import ScanFollower
from tests.navcore.localization.ndt.trellis import mapped_orchard, scan_at

MAP = mapped_orchard()
TRUE = SE3.from_rpy((1.7, 0.4, 1.3), roll=0.02, pitch=-0.015, yaw=0.7)


def off(found: SE3) -> tuple[float, float]:
    """Distance, m, and angle, rad."""
    error = TRUE.inverse() @ found
    return float(np.linalg.norm(error.t)), error.angle()


def test_a_good_guess_takes_fewer_steps_to_the_same_place() -> None:
    follower, guess = ScanFollower(MAP), SE3.from_rpy((0.004, -0.003, 0.0)) @ TRUE
    whole, quick = (follower.match(scan_at(TRUE, 3), guess) for _ in range(2))
    assert quick.iterations < whole.iterations
    assert np.linalg.norm(quick.T_target_source.t - whole.T_target_source.t) < 0.005  # m


def test_a_guess_that_slipped_and_turned_is_still_put_right() -> None:
    follower = ScanFollower(MAP)
    follower.match(scan_at(TRUE, 3), TRUE)
    for seed in range(8):
        way = seed * math.pi / 4.0
        shift = SE3.from_rpy((0.4 * math.cos(way), 0.4 * math.sin(way), 0.0))
        slipped = shift @ TRUE @ SE3.from_rpy((0.0, 0.0, 0.0), yaw=math.radians(6.0))
        distance, angle = off(follower.match(scan_at(TRUE, seed), slipped).T_target_source)
        assert distance < 0.03  # m
        assert angle < math.radians(0.3)


def test_every_tenth_scan_takes_all_descents_whatever_the_last_one_says() -> None:
    follower = ScanFollower(MAP)
    steps = [follower.match(scan_at(TRUE, 3), TRUE).iterations for _ in range(21)]
    assert steps[0] == steps[10] == steps[20]
    assert max(steps[1:10]) < steps[0]
