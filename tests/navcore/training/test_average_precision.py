"""Average precision against cases worked out by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.training.average_precision import (
    FALSE,
    UNASKED,
    Found,
    average_precision,
    judge,
    mean_average_precision,
)
from navcore.training.foot_scores import foot_scores
from navcore.training.samples import Labels

BOXES = np.array([[0.0, 0.0, 10.0, 20.0], [50.0, 0.0, 60.0, 20.0], [100.0, 0.0, 110.0, 20.0]])


def truth(kinds: tuple[int, ...] = (0, 0, 0), ignore: tuple[bool, ...] = (False, False, False)) -> Labels:
    return Labels(boxes=BOXES, kinds=np.array(kinds), ignore=np.array(ignore))


def found(boxes: np.ndarray, confidence: tuple[float, ...], kinds: tuple[int, ...] | None = None) -> Found:
    return Found(boxes=boxes, confidence=np.array(confidence), kinds=np.array(kinds or (0,) * len(boxes)))


def test_all_found_and_nothing_else_is_one() -> None:
    assert average_precision([found(BOXES, (0.9, 0.8, 0.7))], [truth()], 0) == pytest.approx(1.0)


def test_nothing_found_is_zero() -> None:
    assert average_precision([found(np.zeros((0, 4)), ())], [truth()], 0) == 0.0


def test_without_truth_there_is_no_precision() -> None:
    assert math.isnan(average_precision([found(BOXES, (0.9, 0.8, 0.7))], [truth((1, 1, 1))], 0))


def test_a_false_box_between_two_true_ones() -> None:
    """True, false, true of three truths: precision 1 at recall 1/3, 2/3 at recall 2/3."""
    boxes = np.array([BOXES[0], [200.0, 0.0, 210.0, 20.0], BOXES[1]])
    assert average_precision([found(boxes, (0.9, 0.8, 0.7))], [truth()], 0) == pytest.approx((1 + 2 / 3) / 3)


def test_a_truth_found_twice_counts_once() -> None:
    boxes = np.array([BOXES[0], BOXES[0], BOXES[1], BOXES[2]])
    value = average_precision([found(boxes, (0.9, 0.8, 0.7, 0.6))], [truth()], 0)
    assert value == pytest.approx((1 + 2 * 3 / 4) / 3)


def test_an_overlap_below_one_half_is_no_find() -> None:
    shifted = BOXES + np.array((4.0, 0.0, 4.0, 0.0))  # IoU 6 / 14
    assert average_precision([found(shifted, (0.9, 0.8, 0.7))], [truth()], 0) == 0.0


def test_what_lies_on_ignored_objects_counts_neither_way() -> None:
    labels = truth(ignore=(False, True, False))
    assert average_precision([found(BOXES, (0.7, 0.9, 0.8))], [labels], 0) == pytest.approx(1.0)


def test_the_mean_is_over_the_classes_that_occur() -> None:
    one = [found(BOXES[:2], (0.9, 0.8), (0, 1))]
    assert mean_average_precision(one, [truth((0, 1, 1))]) == pytest.approx((1.0 + 0.5) / 2)


def test_feet_are_scored_in_pixels_and_ignored_objects_are_not_missed() -> None:
    labels = truth(ignore=(False, False, True))
    moved = BOXES[:2] + np.array((1.0, 0.0, 1.0, 2.0))
    false = np.array([[300.0, 0.0, 310.0, 20.0]])
    scores = foot_scores([found(np.concatenate((moved, false)), (0.9, 0.8, 0.7))], [labels])
    assert scores.recall == 1.0
    assert scores.precision == pytest.approx(2 / 3)
    assert (scores.median_u_px, scores.median_v_px, scores.bias_v_px) == (1.0, 2.0, 2.0)


def test_ignored_objects_that_are_found_do_not_hurt_precision() -> None:
    labels = truth(ignore=(False, False, True))
    assert foot_scores([found(BOXES, (0.9, 0.8, 0.7))], [labels]).precision == 1.0


def test_a_foot_on_an_ignored_object_is_no_mistake_though_a_counted_one_stands_elsewhere() -> None:
    labels = Labels(
        boxes=np.array([[100.0, 50.0, 110.0, 90.0], [300.0, 50.0, 310.0, 90.0]]), kinds=np.array([0, 0]),
        ignore=np.array([True, False]),
    )  # fmt: skip
    found = Found(boxes=labels.boxes + 1.0, confidence=np.array([0.9, 0.8]), kinds=np.array([0, 0]))
    scores = foot_scores([found], [labels])
    assert (scores.recall, scores.precision) == (1.0, 1.0)


def test_a_box_about_the_seen_part_of_a_hidden_object_is_not_asked() -> None:
    labels = Labels(
        boxes=np.array([[100.0, 50.0, 110.0, 60.0]]), kinds=np.array([0]), ignore=np.array([True])
    )  # fmt: skip
    assert judge(np.array([[100.0, 20.0, 110.0, 90.0]]), labels, 0, 0.5).tolist() == [UNASKED]
    assert judge(np.array([[130.0, 20.0, 140.0, 90.0]]), labels, 0, 0.5).tolist() == [FALSE]


def test_a_thin_far_object_found_a_little_beside_itself_is_not_asked_unless_a_counted_one_is_nearer() -> None:
    ignored, counted = [100.0, 50.0, 103.0, 90.0], [120.0, 50.0, 123.0, 90.0]
    labels = Labels(
        boxes=np.array([ignored, counted]), kinds=np.array([0, 0]), ignore=np.array([True, False])
    )  # fmt: skip
    beside = np.array([[104.0, 50.0, 107.0, 90.0], [115.0, 50.0, 118.0, 90.0]])
    assert judge(beside, labels, 0, 0.5).tolist() == [UNASKED, FALSE]
