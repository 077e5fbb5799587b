"""From the network's maps to boxes."""

from __future__ import annotations

import numpy as np

from navcore.messages import ObjectKind
from navcore.perception.box_decoding import DecodingParams, decode, detected_objects, overlap, suppress


def maps() -> tuple[np.ndarray, np.ndarray]:
    """A trunk of 8 x 40 px whose foot is at (102, 61), and nothing else."""
    peaks, boxes = np.zeros((2, 24, 40), np.float32), np.zeros((4, 24, 40), np.float32)
    peaks[0, 15, 25] = 0.9
    boxes[:, 15, 25] = 0.0, -0.25, np.log(2.0), np.log(10.0)
    return peaks, boxes


def test_a_peak_becomes_the_box_above_its_foot() -> None:
    found, confidence, kinds = decode(*maps(), 4, DecodingParams())
    np.testing.assert_allclose(found, [[98.0, 21.0, 106.0, 61.0]], atol=1e-4)
    np.testing.assert_allclose(confidence, [0.9], atol=1e-6)
    assert kinds == [0]


def test_what_is_below_the_threshold_is_not_found() -> None:
    peaks, boxes = maps()
    found, _, _ = decode(peaks * np.float32(0.3), boxes, 4, DecodingParams(threshold=0.3))
    assert found.shape == (0, 4)


def test_two_feet_on_the_same_spot_are_one_object_of_the_surer_class_if_classes_are_not_kept_apart() -> None:
    peaks, boxes = maps()
    peaks[1, 15, 25] = 0.95
    _, confidence, kinds = decode(peaks, boxes, 4, DecodingParams(across_kinds=True))
    assert (len(confidence), kinds) == (1, [1])
    assert decode(peaks, boxes, 4, DecodingParams())[2] == [1, 0]


def test_neighbours_that_do_not_overlap_both_stay() -> None:
    boxes = np.array([[10.0, 0.0, 18.0, 40.0], [30.0, 0.0, 38.0, 40.0], [10.5, 1.0, 18.5, 41.0]])
    assert suppress(boxes, np.zeros(3, np.int64), DecodingParams()) == [0, 1]


def test_a_vine_before_a_post_stays_and_two_posts_with_one_foot_do_not() -> None:
    boxes = np.array([[10.0, 0.0, 18.0, 40.0], [12.0, 10.0, 17.0, 41.0]])
    assert suppress(boxes, np.array([1, 0]), DecodingParams()) == [0, 1]
    assert suppress(boxes, np.array([1, 1]), DecodingParams()) == [0]
    assert suppress(boxes, np.array([1, 0]), DecodingParams(across_kinds=True)) == [0]


def test_finer_peaks_take_the_values_of_the_cell_around_them_and_of_their_class() -> None:
    peaks, boxes = np.zeros((2, 48, 80), np.float32), np.zeros((8, 24, 40), np.float32)
    peaks[1, 31, 50] = 0.9
    boxes[:4, 15, 25] = 3.0
    boxes[4:, 15, 25] = 0.0, -0.25, np.log(2.0), np.log(10.0)
    found, _, kinds = decode(peaks, boxes, 2, DecodingParams())
    np.testing.assert_allclose(found, [[98.0, 21.0, 106.0, 61.0]], atol=1e-4)
    assert kinds == [1]


def test_overlap_of_known_boxes() -> None:
    box = np.array([0.0, 0.0, 2.0, 2.0])
    others = np.array([[0.0, 0.0, 2.0, 2.0], [1.0, 0.0, 3.0, 2.0], [5.0, 5.0, 6.0, 6.0]])
    np.testing.assert_allclose(overlap(others, box), [1.0, 1 / 3, 0.0])


def test_boxes_are_cut_at_the_picture_and_empty_ones_dropped() -> None:
    boxes = np.array([[-5.0, 10.0, 5.0, 50.0], [700.0, 0.0, 710.0, 10.0]])
    objects = detected_objects(boxes, np.array([0.8, 0.7]), [0, 1], scale=2.0, width_px=1280, height_px=90)
    assert len(objects) == 1
    assert (objects[0].kind, objects[0].x1, objects[0].x2, objects[0].y2) == (ObjectKind.TRUNK, 0.0, 10.0, 90.0)
