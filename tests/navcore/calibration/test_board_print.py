"""The printed board is the board: found in its own print, with squares of the size that is told."""

from __future__ import annotations

import re
from xml.etree import ElementTree as ET

import cv2
import numpy as np
import pytest

from navcore.calibration.board import Board, Image
from navcore.calibration.board_finder import BoardFinder, BoardFinderParams
from navcore.calibration.board_print import RULER_MM, board_svg

SVG = "{http://www.w3.org/2000/svg}"
PX_PER_MM = 4.0
RECTANGLE = re.compile(r"M([\d.]+) ([\d.]+)h([\d.]+)v([\d.]+)h-[\d.]+z")


def printed(board: Board) -> Image:
    """What a printer of 4 dots a mm makes of it."""
    root = ET.fromstring(board_svg(board))
    wide, high = (float(root.attrib[key].removesuffix("mm")) for key in ("width", "height"))
    assert root.attrib["viewBox"] == f"0 0 {wide:g} {high:g}"  # a unit is a mm
    paper = np.full((round(high * PX_PER_MM), round(wide * PX_PER_MM)), 255, dtype=np.uint8)
    for rectangle in RECTANGLE.findall(root.findall(f"{SVG}path")[0].attrib["d"]):
        x, y, w, h = (float(number) * PX_PER_MM for number in rectangle)
        paper[round(y) : round(y + h), round(x) : round(x + w)] = 0
    return paper


@pytest.mark.parametrize("board", [Board(), Board(charuco=True), Board(columns=6, rows=9, square=0.02)], ids=str)
def test_the_board_is_found_in_its_own_print_and_its_squares_have_their_size(board: Board) -> None:
    found = BoardFinder(board, BoardFinderParams()).find(
        np.asarray(cv2.GaussianBlur(printed(board), (0, 0), 1.0), np.uint8)
    )
    assert not isinstance(found, str), found
    assert len(found.ids) == board.columns * board.rows
    right = found.pixels[board.columns - 1] - found.pixels[0]
    squares = np.hypot(*right) / (board.columns - 1) / PX_PER_MM
    assert squares == pytest.approx(1000 * board.square, abs=0.05)  # mm


def test_a_line_of_a_known_length_tells_whether_the_printer_scaled() -> None:
    root = ET.fromstring(board_svg(Board()))
    assert f"h{RULER_MM:g}" in root.findall(f"{SVG}path")[1].attrib["d"]
    assert "this line is 100 mm" in (root.findtext(f"{SVG}text") or "")
