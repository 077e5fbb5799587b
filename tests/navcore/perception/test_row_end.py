"""The row's end from the objects of one picture, and over pictures."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.perception.row_end import RowEnd, RowEndParams, last_object, row_end, seen_to
from navcore.perception.row_lines import GroundRow

PARAMS = RowEndParams()


def seen(*x: float) -> GroundRow:
    """A corridor whose objects stand at these distances ahead."""
    return GroundRow(
        offset=0.0, heading=0.0, width=3.0, covariance=np.eye(2), pitch=0.0, left_x=np.array(x), right_x=np.array(x),
        quality=1.0,
    )  # fmt: skip


@pytest.mark.parametrize(
    ("x", "end"),
    [
        ((3.0, 4.5, 6.0), 6.0),
        ((3.0, 4.5, 6.0, 11.0), 6.0),  # another block of rows beyond the headland
        ((3.0, 4.5, 6.0, 7.5, 9.0), None),  # what follows would be out of range
        ((3.0,), None),
        ((), None),
    ],
)
def test_the_row_ends_before_a_gap_that_lies_within_range(x: tuple[float, ...], end: float | None) -> None:
    assert last_object(np.array(x), PARAMS) == end


@pytest.mark.parametrize(
    ("left", "right", "end"),
    [
        ((3.0, 6.0), (2.0, 5.4), 5.7),  # lines of plants end unevenly
        ((3.0, 6.0), (2.0, 4.0), 6.0),  # the last plants on the right were not seen
        ((3.0, 6.0), (), 6.0),
        ((3.0, 6.0), (5.4, 12.0), 5.7),  # what stands beyond the headland is not this row's
    ],
)
def test_the_end_lies_halfway_between_the_last_plants_of_both_lines(
    left: tuple[float, ...], right: tuple[float, ...], end: float
) -> None:
    assert row_end(np.array(left), np.array(right), PARAMS) == pytest.approx(end)


def test_one_picture_is_not_enough() -> None:
    row_end = RowEnd(PARAMS)
    told = [row_end.update(seen(3.0 - 0.1 * i, 5.5 - 0.1 * i), 0.1) for i in range(5)]
    assert told[: PARAMS.frames - 1] == [None] * (PARAMS.frames - 1)
    assert told[-1] is not None


def test_the_end_comes_closer_by_what_is_driven_when_nothing_is_seen_any_more() -> None:
    row_end = RowEnd(PARAMS)
    for _ in range(6):
        row_end.update(seen(3.0, 5.0), 0.0)
    for _ in range(20):
        told = row_end.update(None, 0.1)
    assert told == pytest.approx(3.0)  # m


def test_objects_beyond_the_end_make_it_unknown_again() -> None:
    row_end = RowEnd(PARAMS)
    for _ in range(6):
        row_end.update(seen(3.0, 5.0), 0.0)
    assert row_end.update(seen(3.0, 5.0, 6.5, 8.0, 9.5), 0.0) is not None
    assert row_end.update(seen(3.0, 5.0, 6.5, 8.0, 9.5), 0.0) is None


def test_one_gap_in_one_picture_does_not_end_the_row() -> None:
    row_end = RowEnd(PARAMS)
    full, gap = seen(3.0, 4.5, 6.0, 7.5, 9.0), seen(3.0, 4.5)
    told = [row_end.update(gap if i % 3 == 0 else full, 0.0) for i in range(20)]
    assert told == [None] * 20


@pytest.mark.parametrize(
    ("x", "to"),
    [
        ((3.0, 4.5, 6.0, 7.5, 9.0), 7.5),  # the last one could be false
        ((3.0, 4.5, 6.0, 7.5, 13.0, 14.0), 6.0),  # beyond a gap is another block
        ((3.0, 4.5, 9.0, 10.5), None),
        ((3.0, 4.5, 6.0), None),
        ((), None),
    ],
)
def test_a_row_surely_goes_on_as_far_as_plants_stand_without_a_gap(x: tuple[float, ...], to: float | None) -> None:
    assert seen_to(np.array(x), PARAMS) == to
