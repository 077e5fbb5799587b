"""Whether a board in a hand is held still, and in a new pose."""

from __future__ import annotations

import numpy as np

from navcore.calibration.session.still_board import StillBoard, StillBoardParams
from tests.navcore.calibration.boards import BOARD, corners_seen, facing
from tests.navcore.calibration.rehearsed import MS


def test_a_hand_that_trembles_is_still_and_one_that_moves_is_not() -> None:
    rng = np.random.default_rng(5)
    still, moving = StillBoard(StillBoardParams()), StillBoard(StillBoardParams())
    for k in range(1, 12):
        calm = moving_share = 0.0
        calm = still.see(corners_seen(facing(0.4, x=0.0005 * (k % 2)), rng), k * 100 * MS)
        moving_share = moving.see(corners_seen(facing(0.4, x=0.01 * k), rng), k * 100 * MS)
    assert calm == 1.0
    assert moving_share < 0.3


def test_pictures_with_a_long_gap_between_them_tell_no_stillness() -> None:
    rng, still = np.random.default_rng(5), StillBoard(StillBoardParams())
    still.see(corners_seen(facing(0.4), rng), 0)
    assert still.see(corners_seen(facing(0.4), rng), 5000 * MS) == 0.0


def test_a_pose_is_new_only_if_a_corner_is_somewhere_else() -> None:
    rng, still = np.random.default_rng(5), StillBoard(StillBoardParams())
    seen = corners_seen(facing(0.4), rng)
    assert not still.is_new(corners_seen(facing(0.4, x=0.002), rng), [seen])
    assert still.is_new(corners_seen(facing(0.4, x=0.05), rng), [seen])
    assert still.is_new(seen, [])
    assert BOARD.columns == 8
