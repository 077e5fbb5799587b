"""Guo-Hall thinning: shapes drawn by hand, and what holds of any."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from navcore.perception.published_fusion.thinning_kernels import thin

Bytes = NDArray[np.uint8]

# Specks grown to blobs, none at the picture's edge.
BLOBS = arrays(np.uint8, (12, 16), elements=st.integers(0, 1)).map(
    lambda specks: np.pad(cv2.dilate(specks, np.ones((3, 3), np.uint8)), 2)
)


def drawn(text: str) -> Bytes:
    return np.array([[c == "#" for c in line.strip()] for line in text.strip().splitlines()], dtype=np.uint8)


def pieces(mask: Bytes) -> tuple[int, int]:
    """Pieces of the shape, all eight neighbours counted, and of what is around it, four counted."""
    return cv2.connectedComponents(mask, connectivity=8)[0], cv2.connectedComponents(1 - mask, connectivity=4)[0]


def test_a_bar_becomes_the_line_along_its_middle() -> None:
    bar = np.zeros((9, 20), np.uint8)
    bar[2:7, 2:18] = 1
    rows, columns = np.nonzero(thin(bar))
    assert set(rows[(columns > 5) & (columns < 14)]) == {4}
    assert sorted(columns) == sorted(set(columns))
    assert np.ptp(columns) > 8


def test_a_ring_stays_a_ring_and_becomes_a_pixel_wide() -> None:
    ring = np.asarray(cv2.circle(np.zeros((21, 21), np.uint8), (10, 10), 7, 1, 4), dtype=np.uint8)
    thinned = thin(ring)
    assert pieces(thinned) == pieces(ring) == (2, 3)
    assert not cv2.erode(thinned, np.ones((2, 2), np.uint8), borderValue=0).any()
    rows, columns = np.nonzero(thinned)
    assert np.hypot(rows - 10, columns - 10) == pytest.approx(7.0, abs=1.5)  # px


def test_a_line_a_pixel_wide_is_left_alone() -> None:
    line = drawn(
        """
        ........
        .#......
        ..#.....
        ...###..
        ......#.
        ........
        """
    )
    assert (thin(line) == line).all()


def test_a_wedge_that_leaves_the_picture_below_keeps_its_middle_down_to_there() -> None:
    wedge = np.zeros((60, 41), np.uint8)
    for row in range(10, 60):
        wedge[row, 20 - row // 4 : 21 + row // 4] = 1
    rows, columns = np.nonzero(thin(wedge))
    assert rows.max() == 59
    assert columns == pytest.approx(20, abs=1)  # px
    assert np.ptp(rows) > 40


def test_nothing_stays_nothing() -> None:
    assert not thin(np.zeros((5, 7), np.uint8)).any()


@given(BLOBS)
@settings(max_examples=60, deadline=None)
def test_a_shape_stays_inside_of_itself_and_as_connected_as_it_was(blobs: Bytes) -> None:
    thinned = thin(blobs)
    assert (thinned <= blobs).all()
    assert pieces(thinned) == pieces(blobs)


@given(BLOBS)
@settings(max_examples=60, deadline=None)
def test_what_is_thin_is_not_thinned_again(blobs: Bytes) -> None:
    once = thin(blobs)
    assert (thin(once) == once).all()
