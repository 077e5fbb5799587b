"""Loss of the published detector: complete IoU, distribution focal loss (Li et al. 2020) and cross entropy.

Weighed as YOLOv8 does.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor
from torch.nn import functional

from navcore.training.box_overlap import complete_iou
from navcore.training.pictures import BatchLabels
from navcore.training.yolo_assignment import Assignment, AssignmentParams, Cells, assign
from navcore.training.yolo_net import BINS, cell_centres, corners, flattened


@dataclass(frozen=True, slots=True, kw_only=True)
class YoloLossParams:
    """Attributes:
    box, classes, distances: weights.
    assignment: which cells answer.
    """

    box: float = 7.5
    classes: float = 0.5
    distances: float = 1.5
    assignment: AssignmentParams = AssignmentParams()


def yolo_loss(maps: tuple[Tensor, ...], labels: BatchLabels, params: YoloLossParams) -> Tensor:
    """Total for a batch; `maps` as of `YoloNet`, in single precision. Nothing here waits for a GPU."""
    centres, strides = cell_centres(maps)
    sides, classes = flattened(maps)
    cells = Cells(boxes=corners(sides, centres, strides), scores=classes.sigmoid(), centres=centres, strides=strides)
    found = assign(cells, labels, params.assignment)
    total = found.score.sum().clamp(min=1.0)
    said = functional.binary_cross_entropy_with_logits(classes, found.score, reduction="none")
    classified = (said * ~found.unasked[..., None]).sum()
    boxed = params.box * (1.0 - complete_iou(cells.boxes, found.boxes))
    boxed = boxed + params.distances * _distance_loss(sides, _distances(cells, found))
    return (params.classes * classified + (boxed * found.score.sum(dim=2)).sum()) / total


def _distances(cells: Cells, found: Assignment) -> Tensor:
    """From the cells' centres to their objects' sides (B, N, 4), strides, as far as can be told."""
    away = torch.cat((cells.centres - found.boxes[..., :2], found.boxes[..., 2:] - cells.centres), dim=2)
    return (away / cells.strides[:, None]).clamp(0.0, BINS - 1.01)


def _distance_loss(logits: Tensor, wanted: Tensor) -> Tensor:
    """Cross entropy (B, N) with the two bins beside each wanted distance (B, N, 4); logits (B, N, 4, BINS)."""
    low = wanted.long()
    share = wanted - low
    chances = logits.log_softmax(dim=3)
    below, above = (chances.gather(3, (low + k)[..., None])[..., 0] for k in (0, 1))
    return -((1.0 - share) * below + share * above).mean(dim=2)
