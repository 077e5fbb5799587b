"""The rehearsal is the same for the same seed, and its truth is not what it tells."""

from __future__ import annotations

import itertools

import numpy as np

from navcore.calibration.board import Board
from navcore.messages import CalibrationJob
from navcore.sim.board_rehearsal import BoardRehearsal, BoardRehearsalParams, told_mount, true_mount


def test_the_same_seed_draws_the_same_pictures_and_scans() -> None:
    first, second = (
        list(
            itertools.islice(BoardRehearsal(CalibrationJob.LIDAR, Board(), BoardRehearsalParams(held=2)).frames(), 4)
        )
        for _ in range(2)
    )
    for a, b in zip(first, second, strict=True):
        assert np.array_equal(a.image, b.image)
        assert np.array_equal(a.distances, b.distances)
    assert not np.array_equal(first[1].image, first[2].image)  # noise is new in each picture


def test_the_told_mount_is_as_far_off_as_a_ruler() -> None:
    off = np.linalg.inv(true_mount()) @ told_mount()
    assert 0.02 < np.linalg.norm(off[:3, 3]) < 0.06  # m
    turn_deg = np.degrees(np.arccos((np.trace(off[:3, :3]) - 1.0) / 2.0))
    assert 2.0 < turn_deg < 5.0
