"""A large picture is looked at whole and in slices: each object is told once, and thin ones do not vanish."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from navcore.messages import DetectedObject, ObjectKind
from navcore.perception.detector import Image
from navcore.perception.picture_fit import fit_picture
from navcore.perception.sliced_detector import SlicedDetector


class FindsWhite:
    """White bars on black, in a picture as small as a network's input."""

    def __init__(self) -> None:
        self.looks = 0

    def detect(self, image: Image) -> tuple[DetectedObject, ...]:
        self.looks += 1
        fitted, scale = fit_picture(image, 384, 640)
        _, _, stats, _ = cv2.connectedComponentsWithStats((fitted[..., 0] > 200).astype(np.uint8))
        return tuple(
            DetectedObject(
                kind=ObjectKind.TRUNK, confidence=0.9, x1=x / scale, y1=y / scale, x2=(x + w) / scale,
                y2=(y + h) / scale,
            )
            for x, y, w, h, _ in stats[1:].tolist()
        )  # fmt: skip


def with_bars(width_px: int, height_px: int, bars: list[tuple[int, int, int, int]]) -> Image:
    image = np.zeros((height_px, width_px, 3), dtype=np.uint8)
    for x, y, w, h in bars:
        image[y : y + h, x : x + w] = 255
    return image


@pytest.mark.parametrize(("width_px", "height_px"), [(640, 640), (1280, 720), (800, 384)])
def test_each_object_is_told_once_and_where_it_stands(width_px: int, height_px: int) -> None:
    bars = [(60 * k + 20, int(17 * k % (height_px - 120)), 12, 100) for k in range(width_px // 60)]
    found = SlicedDetector(FindsWhite()).detect(with_bars(width_px, height_px, bars))
    assert len(found) == len(bars)
    for seen, (x, y, w, h) in zip(sorted(found, key=lambda o: o.x1), bars, strict=True):
        assert (seen.x1, seen.x2, seen.y2) == pytest.approx((x, x + w, y + h), abs=3.0)  # px


def test_a_thin_object_that_a_small_picture_loses_is_found() -> None:
    image, detector = with_bars(1280, 1280, [(700, 500, 2, 90)]), FindsWhite()
    assert detector.detect(image) == ()
    [found] = SlicedDetector(detector).detect(image)
    assert (found.x1, found.y2) == (700.0, 590.0)


def test_a_picture_no_larger_than_a_slice_is_looked_at_once() -> None:
    detector = FindsWhite()
    [found] = SlicedDetector(detector).detect(with_bars(640, 360, [(100, 100, 10, 80)]))
    assert detector.looks == 1
    assert found.y2 == 180.0


def test_nothing_is_found_in_an_empty_picture() -> None:
    assert SlicedDetector(FindsWhite()).detect(with_bars(1920, 1080, [])) == ()
