"""Paper B's rival that segments the ground: from masks to the row, and what the shipped net makes of a picture."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.errors import ConfigError, ContractError, ModelError
from navcore.geometry.pinhole import PinholeCamera, robot_camera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, RowObservation
from navcore.perception.detector import Image
from navcore.perception.image_lines import driving_camera
from navcore.perception.onnx_detector import WEIGHTS as DETECTOR
from navcore.perception.published_fusion.ground_segmenter import (
    SIDE_PX,
    WEIGHTS,
    GroundSegmenter,
    GroundSegmenterParams,
)
from navcore.perception.published_fusion.ground_skeleton import (
    BROKEN,
    NO_GROUND,
    GroundSkeletonParams,
    cleaned,
    mask_line,
)
from navcore.perception.published_fusion.skeleton_chain import SegmentationSkeleton, SkeletonChainParams

Mask = NDArray[np.bool_]

CAMERA = robot_camera()
PICTURE = np.zeros((360, 640, 3), np.uint8)


@dataclass
class Drawn:
    """A segmentation that knows the answer."""

    mask: Mask

    def segment(self, image: Image) -> Mask:
        return self.mask


def corridor(pose: SE2, *, width: float = 2.5, end: float = 15.0, camera: PinholeCamera = CAMERA) -> Mask:
    """The ground between two straight lines along x, seen from a pose beside their middle."""
    step_u, step_v = camera.width_px / SIDE_PX, camera.height_px / SIDE_PX
    u, v = np.meshgrid((np.arange(SIDE_PX) + 0.5) * step_u, (np.arange(SIDE_PX) + 0.5) * step_v)
    ground = driving_camera(camera).ground(np.column_stack((u.ravel(), v.ravel())))
    x, y = pose.apply(np.nan_to_num(ground, nan=-99.0)).T
    return np.asarray((np.abs(y) < width / 2) & (x > -5.0) & (x < end)).reshape(SIDE_PX, SIDE_PX)


def seen(mask: Mask, camera: PinholeCamera = CAMERA) -> RowObservation:
    return SegmentationSkeleton(camera, Drawn(mask), SkeletonChainParams()).process(7, PICTURE).found.row


@given(left=st.floats(-0.3, 0.3), turn=st.floats(-0.08, 0.08), width=st.floats(2.0, 2.6))
@settings(max_examples=25, deadline=None)
def test_the_row_is_where_its_ground_lies(left: float, turn: float, width: float) -> None:
    """Wider ones leave the picture on one side, where the skeleton bends."""
    row = seen(corridor(SE2(0.0, left, turn), width=width))
    assert (row.valid, row.reason, row.stamp_ns, row.camera) == (True, "", 7, CameraName.FRONT)
    assert row.offset == pytest.approx(-left, abs=0.12)  # m
    assert row.heading == pytest.approx(-turn, abs=0.03)  # rad
    assert row.left_seen
    assert row.right_seen


def test_the_skeleton_lies_along_the_rows_middle_from_the_pictures_lower_edge_on() -> None:
    eye = Drawn(corridor(SE2(0.0, 0.1, 0.0), width=2.0))
    found = SegmentationSkeleton(CAMERA, eye, SkeletonChainParams()).process(0, PICTURE).found
    on = found.points[found.kept]
    nearest = CAMERA.ground(np.array([(320.0, 360.0)]))[0, 0]
    assert on[:, 0].min() == pytest.approx(nearest, abs=0.05)  # m
    assert 8.0 < on[:, 0].max() < 15.0  # m: the corridor's end
    assert on[:, 1] == pytest.approx(-0.1, abs=0.25)  # m: a pixel of the raster, far away


def test_it_tells_neither_the_rows_width_nor_its_end() -> None:
    row = seen(corridor(SE2(0.0, 0.1, 0.0)))
    assert (row.width, row.end_distance, row.seen_to) == (None, None, None)


def test_specks_and_holes_do_not_move_the_line() -> None:
    clean = corridor(SE2(0.0, 0.1, 0.02))
    dirty, rng = clean.copy(), np.random.default_rng(3)
    for row, column in rng.integers(2, SIDE_PX - 2, (60, 2)):
        dirty[row - 1 : row + 2, column - 1 : column + 2] ^= True
    params = GroundSkeletonParams()
    changed = (cleaned(dirty, params) != cleaned(clean, params)).sum()
    assert changed < 0.5 * (dirty != clean).sum()
    first, second = seen(clean), seen(dirty)
    assert second.offset == pytest.approx(first.offset, abs=0.05)  # m
    assert second.heading == pytest.approx(first.heading, abs=0.02)  # rad


def test_no_ground_gives_no_row_and_says_so() -> None:
    specks = np.zeros((SIDE_PX, SIDE_PX), np.bool_)
    specks[100:104, ::8] = True
    for mask in (np.zeros_like(specks), specks):
        row = seen(mask)
        assert (row.valid, row.reason) == (False, NO_GROUND)


def test_ground_without_a_middle_gives_no_row_and_says_so() -> None:
    everywhere, band = np.ones((SIDE_PX, SIDE_PX), np.bool_), np.zeros((SIDE_PX, SIDE_PX), np.bool_)
    band[110:125] = True
    for mask in (everywhere, band):
        row = seen(mask)
        assert (row.valid, row.reason) == (False, BROKEN)


def test_a_row_is_kept_for_half_a_second_and_forgotten_on_request() -> None:
    eye = Drawn(corridor(SE2(0.0, 0.1, 0.0)))
    chain = SegmentationSkeleton(CAMERA, eye, SkeletonChainParams())
    assert chain.process(0, PICTURE).found.row.quality > 0.5
    eye.mask = np.zeros_like(eye.mask)
    kept = [chain.process(k, PICTURE).found.row for k in range(1, 7)]
    assert [row.valid for row in kept] == [True] * 5 + [False]
    assert not any(row.quality or row.left_seen for row in kept)
    eye.mask = corridor(SE2(0.0, 0.1, 0.0))
    chain.process(8, PICTURE)
    chain.forget()
    eye.mask = np.zeros_like(eye.mask)
    assert not chain.process(9, PICTURE).found.row.valid


def test_a_rear_camera_sees_the_row_its_own_way() -> None:
    rear = robot_camera(rear=True)
    front, back = seen(corridor(SE2(0.0, 0.1, 0.02))), seen(corridor(SE2(0.0, 0.1, 0.02), camera=rear), rear)
    assert back.camera is CameraName.REAR
    assert (back.offset, back.heading) == pytest.approx((front.offset, front.heading))


def test_a_picture_or_mask_of_another_shape_is_refused() -> None:
    chain = SegmentationSkeleton(CAMERA, Drawn(corridor(SE2(0.0, 0.0, 0.0))), SkeletonChainParams())
    with pytest.raises(ContractError, match="360 x 640"):
        chain.process(0, PICTURE[:100])
    for bad in (np.zeros(5, np.bool_), np.full((4, 4), math.nan)):
        with pytest.raises(ContractError, match="mask of the ground"):
            mask_line(bad, GroundSkeletonParams())


def test_values_that_make_no_sense_are_refused() -> None:
    for bad in ({"opening_px": 0}, {"min_ground": 0.8}, {"raster": (0, 100)}):
        with pytest.raises(ConfigError, match="skeleton"):
            GroundSkeletonParams(**bad)
    with pytest.raises(ConfigError, match="threshold"):
        GroundSegmenterParams(threshold=math.nan)


def test_the_same_picture_gives_the_same_mask_whatever_its_size() -> None:
    image = np.random.default_rng(1).integers(0, 255, (360, 640, 3), dtype=np.uint8)
    segmenter = GroundSegmenter()
    assert (segmenter.segment(image) == GroundSegmenter().segment(image)).all()
    assert segmenter.segment(image[:100, :90]).shape == (SIDE_PX, SIDE_PX)


def test_a_missing_damaged_or_other_model_is_named(tmp_path: Path) -> None:
    cut = tmp_path / "cut.onnx"
    cut.write_bytes(WEIGHTS.read_bytes()[:2000])
    for path, said in (
        (tmp_path / "none.onnx", "no ground segmentation at .*train-ground"),
        (cut, "damaged or no ONNX model"),
        (DETECTOR, "is no ground segmentation"),
    ):
        with pytest.raises(ModelError, match=said):
            GroundSegmenter(replace(GroundSegmenterParams(), weights=path))
