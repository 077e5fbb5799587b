"""Where crops of training pictures lie, and that boxes follow them."""

from __future__ import annotations

import numpy as np
import pytest
import torch

from navcore.training.augment import AugmentParams, augment, random_crop
from navcore.training.pictures import stack_labels
from navcore.training.samples import Labels

CPU = torch.device("cpu")


def test_crops_lie_about_feet_with_another_beside_them_as_often_as_asked() -> None:
    boxes = np.array([[100.0, 50.0, 104.0, 120.0], [104.0, 50.0, 108.0, 120.0], [500.0, 50.0, 504.0, 120.0]])
    labels = Labels(boxes=boxes, kinds=np.array([0, 1, 0]), ignore=np.zeros(3, dtype=np.bool_))
    many, rng = stack_labels([labels] * 300, [1.0] * 300, CPU), torch.Generator().manual_seed(2)
    for crowded, least, most in ((1.0, 0.55, 0.78), (1e6, 0.999, 1.0)):
        shape = AugmentParams(foot_share=1.0, crowded=crowded, scale=1.0001, stretch=1.0)
        crop = random_crop(torch.Size((384, 640)), many, shape, rng)
        assert least <= float((crop.u0 < 200).float().mean()) <= most


def test_boxes_follow_the_pixels_when_a_picture_is_cropped_scaled_and_mirrored() -> None:
    image = np.zeros((360, 640, 3), np.uint8)
    image[100:200, 300:320] = 255
    labels = Labels(boxes=np.array([[300.0, 100.0, 320.0, 200.0]]), kinds=np.array([0]), ignore=np.array([False]))
    plain = AugmentParams(
        gain=1.0, gamma=1.0, noise=0.0, fade=0.0, blur_share=0.0, foot_share=1.0, width_px=320, height_px=320
    )
    rng = torch.Generator().manual_seed(4)
    tensor = torch.from_numpy(image).permute(2, 0, 1)[None].expand(8, -1, -1, -1)
    crops, moved = augment(tensor, stack_labels([labels] * 8, [1.0] * 8, CPU), plain, rng)
    for crop, box in zip(crops, moved.boxes, strict=True):
        rows, columns = torch.nonzero(crop[0] > 0.5, as_tuple=True)
        x1, y1, x2, y2 = box[0].clamp(0, 320).tolist()
        assert (int(columns.min()), int(rows.min())) == pytest.approx((x1, y1), abs=1.5)  # px
        assert (int(columns.max()) + 1, int(rows.max()) + 1) == pytest.approx((x2, y2), abs=1.5)  # px
    assert len({tuple(box) for box in moved.boxes[:, 0].tolist()}) == 8
