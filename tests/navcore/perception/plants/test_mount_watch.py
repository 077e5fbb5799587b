"""Trunks that both see tell whether the camera still looks where it was calibrated to look."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.geometry.pinhole import robot_camera
from navcore.messages import MountAgreement, ScannedPlant
from navcore.perception.plants.mount_watch import MountWatch

CAMERA = robot_camera()
SECOND = 1_000_000_000


def seen(
    watch: MountWatch, stamp_ns: int, plants: dict[int, tuple[float, float]], turned: float, rng: np.random.Generator
) -> MountAgreement | None:
    """A picture of trunks by number, of a camera that looks further left by `turned` rad than it should."""
    boxed, bearings = [], []
    for k, (number, (x, y)) in enumerate(plants.items()):
        boxed.append(ScannedPlant(number=number, x=x, y=y, diameter=0.09, sureness=0.95, side=1, object=k))
        true = math.atan2(y - CAMERA.y, x - CAMERA.x)
        bearings.append(true - turned + rng.normal(0.0, 0.008))
    return watch.see(stamp_ns, list(plants), boxed, np.array(bearings))


def told_in_a_row(turned: float, trunks: int, seed: int) -> MountAgreement:
    """What is known at the end of a row, every trunk of which was in ten pictures."""
    rng, watch, last = np.random.default_rng(seed), MountWatch(CAMERA), None
    for number in range(trunks):
        side = 1.3 if number % 2 else -1.3
        for k in range(10):
            stamp_ns = (10 * number + k) * SECOND // 10
            last = seen(watch, stamp_ns, {number: (4.4 - 0.1 * k, side)}, turned, rng) or last
    assert last is not None
    return last


@pytest.mark.parametrize("turned_deg", [1.5, -1.5])
def test_a_camera_that_was_knocked_aside_is_told_within_a_row(turned_deg: float) -> None:
    told = [told_in_a_row(math.radians(turned_deg), 30, seed) for seed in range(10)]
    assert all(t.moved for t in told)
    assert all(t.yaw * turned_deg > 0.0 for t in told)


def test_a_camera_as_it_was_calibrated_is_no_alarm_over_many_rows() -> None:
    assert not any(told_in_a_row(0.0, 60, seed).moved for seed in range(30))


def test_a_trunk_is_asked_once_however_many_pictures_show_it() -> None:
    assert told_in_a_row(0.0, 7, 1).trunks == 7


def test_a_number_that_comes_back_after_a_minute_is_another_trunk() -> None:
    rng, watch = np.random.default_rng(1), MountWatch(CAMERA)
    first = seen(watch, 0, {3: (3.0, 1.3)}, 0.0, rng)
    assert seen(watch, SECOND, {3: (2.9, 1.3)}, 0.0, rng) is None
    again = seen(watch, 61 * SECOND, {3: (3.0, 1.3)}, 0.0, rng)
    assert first is not None
    assert again is not None
    assert (first.trunks, again.trunks) == (1, 2)


def test_far_trunks_and_unsure_ones_are_not_asked() -> None:
    rng, watch = np.random.default_rng(1), MountWatch(CAMERA)
    assert seen(watch, 0, {1: (7.0, 1.3), 2: (1.2, 0.8)}, 0.0, rng) is None
