"""What a row's fit counts once though the detector tells it twice."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.geometry.pinhole import robot_camera
from navcore.messages import CameraName, CameraView, DetectedObject, ObjectKind
from navcore.perception.detector import Told
from navcore.perception.one_per_foot import one_per_foot
from navcore.perception.row_perception import RowPerception, RowPerceptionParams

CAMERA = robot_camera()


def standing(x: float, y: float, kind: ObjectKind, confidence: float, wide: float = 0.08) -> DetectedObject:
    """Something of 1.5 m at a place on level ground, m."""
    down = CAMERA.pitch
    ahead = x - CAMERA.x
    depth = ahead * np.cos(down) + CAMERA.z * np.sin(down)
    u = CAMERA.cx - CAMERA.fx * y / depth
    v = CAMERA.cy + CAMERA.fy * (CAMERA.z * np.cos(down) - ahead * np.sin(down)) / depth
    half, height = CAMERA.fx * wide / depth / 2, CAMERA.fy * 1.5 / depth
    return DetectedObject(kind=kind, confidence=confidence, x1=u - half, y1=max(v - height, 0.0), x2=u + half, y2=v)


def row() -> list[DetectedObject]:
    """Posts of a corridor that is 3 m wide."""
    return [
        standing(x, side, ObjectKind.POST, 0.9 - 0.01 * x) for x in np.arange(3.0, 11.0, 1.3) for side in (1.5, -1.5)
    ]


def seen(objects: list[DetectedObject]) -> CameraView:
    image = np.random.default_rng(1).integers(0, 255, (CAMERA.height_px, CAMERA.width_px, 3), dtype=np.uint8)
    told = Told(tuple(sorted(objects, key=lambda o: -o.confidence)))
    return RowPerception(CAMERA, told, RowPerceptionParams()).process(image, 0, CameraName.FRONT)


def test_of_a_vine_before_its_post_the_surer_one_stays_and_their_neighbour_too() -> None:
    objects = [
        standing(4.0, 1.5, ObjectKind.POST, 0.9), standing(4.02, 1.5, ObjectKind.TRUNK, 0.8),
        standing(4.0, -1.5, ObjectKind.TRUNK, 0.7),
    ]  # fmt: skip
    assert one_per_foot(objects, CAMERA.width_px).tolist() == [0, 2]
    assert one_per_foot([], CAMERA.width_px).tolist() == []


def test_feet_are_as_far_apart_in_a_picture_of_twice_the_size() -> None:
    posts = [
        DetectedObject(kind=kind, confidence=0.9, x1=100.0 + off, y1=100.0, x2=103.0 + off, y2=200.0)
        for kind, off in ((ObjectKind.POST, 0.0), (ObjectKind.TRUNK, 6.0))
    ]
    assert one_per_foot(posts, 640).tolist() == [0, 1]
    assert one_per_foot(posts, 1280).tolist() == [0]


def test_a_row_with_doubles_is_fitted_as_the_row_without_them_and_shows_them_all() -> None:
    once, doubles = row(), [standing(3.0, -1.47, ObjectKind.TRUNK, 0.5), standing(4.3, -1.47, ObjectKind.TRUNK, 0.5)]
    plain, doubled = seen(once), seen(once + doubles)
    assert plain.row.valid
    assert len(doubled.objects) == len(once) + len(doubles)
    assert (doubled.row.offset, doubled.row.heading, doubled.row.objects) == pytest.approx(
        (plain.row.offset, plain.row.heading, plain.row.objects), abs=1e-12
    )
