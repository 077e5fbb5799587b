"""How well a segmentation's file tells the ground of pictures that it was not trained on."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from navcore.perception.published_fusion.ground_segmenter import GroundSegmenter, GroundSegmenterParams
from navcore.sim.young_orchard import Segment
from navcore.training.ground_mask.ground_pictures import GroundPictures
from navcore.training.ground_mask.ground_trainer import mean_iou


def score_lines(path: Path, pictures: GroundPictures) -> Iterator[str]:
    """Mean IoU of all pictures, then of each segment's."""
    segmenter = GroundSegmenter(GroundSegmenterParams(weights=path))
    found = np.array([segmenter.segment(square) for square in pictures.squares])
    yield f"IoU {mean_iou(found, pictures.masks):.3f} on {len(found)} pictures"
    for segment in Segment:
        of_it = np.array([s is segment for s in pictures.segments])
        yield f"  {segment}: {mean_iou(found[of_it], pictures.masks[of_it]):.3f} on {int(of_it.sum())}"
