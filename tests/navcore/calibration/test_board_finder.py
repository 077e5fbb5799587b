"""Boards are found to a part of a pixel, and where there is none the reason is said."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.calibration.board import Board, BoardSighting
from navcore.calibration.board_finder import BoardFinder, BoardFinderParams
from navcore.errors import InputError
from navcore.sim.board_pictures import BoardPictureParams, BoardPictures
from tests.navcore.calibration.boards import BOARD, CAMERA, LENS, Floats, corners_seen, facing

Image = NDArray[np.uint8]
FINDER = BoardFinder(BOARD, BoardFinderParams())
CHARUCO = Board(charuco=True)
TILTED = facing(0.3, x=-0.03, y=0.02, turn=0.3)
TILTED[:3, :3] = TILTED[:3, :3] @ np.array([[0.88, 0.0, 0.475], [0.0, 1.0, 0.0], [-0.475, 0.0, 0.88]])


def picture(T: Floats, board: Board = BOARD, params: BoardPictureParams | None = None) -> Image:
    return BoardPictures(CAMERA, LENS, board, params or BoardPictureParams()).render(T, np.random.default_rng(3))


def found(image: Image, finder: BoardFinder = FINDER) -> BoardSighting:
    sighting = finder.find(image, "it")
    assert isinstance(sighting, BoardSighting), sighting
    return sighting


def reason(image: Image, finder: BoardFinder = FINDER) -> str:
    told = finder.find(image)
    assert isinstance(told, str)
    return told


@pytest.mark.parametrize("board", [BOARD, CHARUCO, Board(columns=7, rows=6, square=0.03)])
def test_corners_are_where_the_camera_shows_them(board: Board) -> None:
    sighting = found(picture(TILTED, board), BoardFinder(board, BoardFinderParams()))
    true = corners_seen(TILTED, np.random.default_rng(0), board=board, std_px=0.0)
    assert len(sighting.ids) == board.columns * board.rows
    error = sighting.pixels - true.pixels[sighting.ids]
    if board.columns == 7:  # its ends are alike: it may be seen turned round
        error = min(error, sighting.pixels - true.pixels[::-1], key=lambda e: float(np.abs(e).max()))
    assert np.sqrt(np.mean(error**2)) < 0.15  # px
    assert np.abs(error).max() < 0.6  # px


def test_an_upside_down_picture_shows_the_board_turned_by_half_a_turn() -> None:
    image = picture(TILTED)
    upright, turned = found(image), found(np.ascontiguousarray(image[::-1, ::-1]))
    assert (CAMERA.width_px - 1, CAMERA.height_px - 1) - turned.pixels == pytest.approx(upright.pixels, abs=0.3)  # px


@pytest.mark.parametrize("hard", [True, False])
def test_a_board_may_lie_on_its_side(hard: bool) -> None:
    T = facing(0.4, turn=np.pi / 2)
    sighting = found(picture(T), BoardFinder(BOARD, BoardFinderParams(tries_hard=hard)))
    assert sighting.pixels == pytest.approx(corners_seen(T, np.random.default_rng(0), std_px=0.0).pixels, abs=0.6)


def test_part_of_a_charuco_board_is_enough() -> None:
    image = picture(facing(0.3), CHARUCO)
    sighting = found(np.ascontiguousarray(image[:, :345]), BoardFinder(CHARUCO, BoardFinderParams()))
    assert 8 <= len(sighting.ids) < 40
    true = corners_seen(facing(0.3), np.random.default_rng(0), board=CHARUCO, std_px=0.0)
    assert sighting.pixels == pytest.approx(true.pixels[sighting.ids], abs=0.6)  # px


@pytest.mark.parametrize(
    ("image", "words"),
    [
        (np.zeros((360, 640), np.uint8), "black"),
        (np.full((360, 640), 250, np.uint8), "white all over"),
        (np.full((360, 640, 3), 120, np.uint8), "shows nothing"),
        (np.zeros((5, 5), np.uint8), "no picture"),
        (np.zeros((40, 10_001), np.uint8), "wider or higher"),
        (np.random.default_rng(1).integers(0, 255, (360, 640)).astype(np.uint8), "No board of 8 x 5"),
    ],
)  # fmt: skip
def test_a_picture_without_a_board_says_why(image: Image, words: str) -> None:
    assert words in reason(image)


def test_a_board_of_another_size_is_told_with_its_size() -> None:
    assert "of 7 x 6 inner corners is seen, not of 8 x 5" in reason(picture(TILTED, Board(columns=7, rows=6)))


def test_a_board_that_is_cut_off_says_at_which_edge() -> None:
    assert "cut off at the picture's right edge" in reason(np.ascontiguousarray(picture(facing(0.3))[:, :400]))


def test_a_blurred_board_is_refused() -> None:
    assert "blurred" in reason(picture(facing(0.25), params=BoardPictureParams(blur_px=3.5)))


def test_a_charuco_board_of_another_size_or_none_says_so() -> None:
    finder = BoardFinder(CHARUCO, BoardFinderParams())
    assert "No marker" in reason(picture(TILTED), finder)
    few = np.ascontiguousarray(picture(facing(0.3), CHARUCO)[:, :265])
    assert "Show more of it" in reason(few, finder) or "markers are seen" in reason(few, finder)


@pytest.mark.parametrize(
    "wrong", [{"columns": 2}, {"rows": 40}, {"square": 0.0}, {"square": float("nan")}, {"width": 0.1},
              {"columns": 20, "rows": 20, "charuco": True}, {"height": float("nan")}],
)  # fmt: skip
def test_a_board_that_cannot_be_is_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(InputError):
        Board(**wrong)  # type: ignore[arg-type]
