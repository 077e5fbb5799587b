"""Pictures of a corridor's ground, the net that learns from them, and the one that is shipped."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import torch

from navcore.errors import InputError
from navcore.geometry.pinhole import robot_camera
from navcore.geometry.se2 import SE2
from navcore.messages import SimTruth
from navcore.perception.published_fusion.ground_segmenter import SIDE_PX, GroundSegmenter, GroundSegmenterParams
from navcore.sim.camera_light import LightName, named_light
from navcore.sim.camera_renderer import CameraRenderer, RenderedFrame, RenderParams
from navcore.sim.corridor_ground import segment_corridor
from navcore.sim.planting import build_orchard
from navcore.sim.young_orchard import LENGTH_M, Segment, YoungSegment, tuning_segment
from navcore.training.ground_mask.ground_export import export_ground
from navcore.training.ground_mask.ground_net import GroundNet
from navcore.training.ground_mask.ground_pictures import (
    TRAINING,
    VALIDATION,
    GroundPictures,
    GroundPicturesParams,
    random_pose,
    squeezed_mask,
)
from navcore.training.ground_mask.ground_trainer import GroundTrainerParams, mean_iou, train_ground

# A planting that the net never saw: neither trained nor validated on.
YOUNG = tuning_segment(Segment.MIXED, 50)


@pytest.fixture(scope="module")
def frame() -> RenderedFrame:
    return rendered(YOUNG, along=5.0, left=0.2)


def rendered(young: YoungSegment, *, along: float, left: float) -> RenderedFrame:
    orchard, corridor = build_orchard(young.site, replace(young.orchard, seed=young.seed)), segment_corridor(young)
    light = named_light(LightName.OVERCAST, seed=young.seed)
    T_map_row = corridor.T_row_map.inverse()
    x, y = T_map_row.apply_point(along, left)
    truth = SimTruth(stamp_ns=0, x=x, y=y, yaw=T_map_row.yaw, roll=0.0, pitch=0.0, v=0.0, omega=0.0)
    return CameraRenderer(orchard, robot_camera(), light, RenderParams(corridor=corridor)).render(truth, 0)


def test_a_corridor_holds_what_lies_between_its_trees_and_no_more() -> None:
    corridor = segment_corridor(YOUNG)
    assert 25 <= len(corridor.left) + len(corridor.right) <= 32
    T_map_row = corridor.T_row_map.inverse()
    for line, inwards in ((corridor.left, -0.05), (corridor.right, 0.05)):
        step = np.array((0.0, inwards))
        assert corridor.holds(T_map_row.apply(line + step)).all()
        assert not corridor.holds(T_map_row.apply(line - step)).any()
    middle = np.array([(x, 0.0) for x in (-0.1, 0.1, LENGTH_M - 0.1, LENGTH_M + 0.1)])
    assert corridor.holds(T_map_row.apply(middle)).tolist() == [False, True, True, False]


def test_the_ground_in_a_picture_is_the_corridors_but_for_what_stands_before_it(frame: RenderedFrame) -> None:
    assert frame.ground is not None
    corridor, camera = segment_corridor(YOUNG), robot_camera()
    u, v = np.meshgrid(np.arange(camera.width_px) + 0.5, np.arange(camera.height_px) + 0.5)
    plane = np.nan_to_num(SE2(5.0, 0.2, 0.0).apply(camera.ground(np.column_stack((u.ravel(), v.ravel())))), nan=-99.0)
    between = corridor.holds(corridor.T_row_map.inverse().apply(plane)).reshape(frame.ground.shape)
    assert (frame.ground & between).sum() > 0.95 * frame.ground.sum()  # weeds in it rise above it
    assert (frame.ground & between).sum() > 0.85 * between.sum()  # trunks and stakes hide some
    assert not frame.ground[:130].any()  # px: the horizon is lower
    assert squeezed_mask(frame).mean() == pytest.approx(frame.ground.mean(), abs=0.02)


def test_no_ground_is_told_where_none_was_asked_for() -> None:
    young = YOUNG
    orchard = build_orchard(young.site, replace(young.orchard, seed=young.seed))
    small = robot_camera(width_px=64, height_px=36)
    truth = SimTruth(stamp_ns=0, x=0.0, y=0.0, yaw=0.0, roll=0.0, pitch=0.0, v=0.0, omega=0.0)
    assert CameraRenderer(orchard, small, named_light(LightName.NOON)).render(truth, 0).ground is None


def test_the_shipped_net_tells_the_ground_of_a_planting_that_it_never_saw(frame: RenderedFrame) -> None:
    found = GroundSegmenter().segment(frame.image)
    assert mean_iou(found[None], squeezed_mask(frame)[None]) > 0.85


def test_pictures_are_taken_in_the_row_from_plantings_that_are_neither_driven_nor_held_out() -> None:
    params = GroundPicturesParams()
    indices = range(TRAINING, TRAINING + params.plantings)
    assert VALIDATION not in indices
    assert min(indices) > 10  # runs of the bench's tuning segments
    corridor, rng = segment_corridor(YOUNG), np.random.default_rng(1)
    for _ in range(50):
        pose = random_pose(corridor, params, rng)
        along, left = corridor.T_row_map.apply_point(pose.x, pose.y)
        assert -params.before <= along <= LENGTH_M
        assert abs(left) < params.left + 0.6  # m: bends and planting


def test_iou_counts_common_pixels_and_an_empty_picture_as_right() -> None:
    a, b = np.zeros((2, 2, 4), np.bool_), np.zeros((2, 2, 4), np.bool_)
    a[0, 0, :3], b[0, 0, 1:] = True, True
    assert mean_iou(a, b) == pytest.approx((2 / 4 + 1.0) / 2)
    assert mean_iou(a[:1], b[1:]) == 0.0


def simple_pictures(count: int) -> GroundPictures:
    """Ground that is red, somewhere in the lower half."""
    rng = np.random.default_rng(2)
    squares = rng.integers(0, 60, (count, SIDE_PX, SIDE_PX, 3), dtype=np.uint8)
    masks = np.zeros((count, SIDE_PX, SIDE_PX), np.bool_)
    for mask, left in zip(masks, rng.integers(10, 80, count), strict=True):
        mask[90:, left : left + 60] = True
    squares[masks] = (20, 20, 220)
    return GroundPictures(squares, masks, (Segment.STRAIGHT,) * count)


def test_a_net_learns_what_it_is_shown_the_same_each_time_and_its_file_tells_the_same(tmp_path: Path) -> None:
    pictures, params = simple_pictures(4), GroundTrainerParams(epochs=15, batch=2, average=0.5)
    told: list[str] = []
    net = train_ground(pictures, simple_pictures(1), params, told.append)
    assert len(told) == 15
    assert export_ground(net, tmp_path / "ground.onnx") < 1e-3
    segmenter = GroundSegmenter(GroundSegmenterParams(weights=tmp_path / "ground.onnx"))
    found = np.array([segmenter.segment(square) for square in pictures.squares])
    assert mean_iou(found, pictures.masks) > 0.8
    short = replace(params, epochs=1)
    first, second = (train_ground(pictures, simple_pictures(1), short, told.append) for _ in range(2))
    assert all(torch.equal(a, b) for a, b in zip(first.parameters(), second.parameters(), strict=True))


def test_a_net_answers_for_each_pixel() -> None:
    assert GroundNet()(torch.zeros(2, 3, SIDE_PX, SIDE_PX)).shape == (2, 1, SIDE_PX, SIDE_PX)
    assert sum(p.numel() for p in GroundNet().parameters()) < 200_000


def test_training_without_a_pass_or_picture_is_refused() -> None:
    with pytest.raises(InputError, match="one pass"):
        GroundTrainerParams(epochs=0)
