"""Which cells of the published detector answer for which object: task-aligned assignment (Feng et al. 2021)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import torch
from torch import Tensor
from torch.nn import functional

from navcore.training.box_overlap import complete_iou
from navcore.training.model import CLASSES
from navcore.training.pictures import BatchLabels

# More objects than that are not asked for in one picture; a GPU's memory goes by it.
MOST_OBJECTS = 64


@dataclass(frozen=True, slots=True, kw_only=True)
class AssignmentParams:
    """YOLOv8's values.

    Attributes:
        candidates: so many cells may answer for an object.
        alpha, beta: exponents of score and overlap in their choice.
    """

    candidates: int = 10
    alpha: float = 0.5
    beta: float = 6.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Cells:
    """What B pictures' N cells say.

    boxes: (B, N, 4) pixels. scores: (B, N, 2) 0 to 1. centres: (N, 2) and strides: (N,) pixels.
    """

    boxes: Tensor
    scores: Tensor
    centres: Tensor
    strides: Tensor


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Assignment:
    """Attributes (B pictures, N cells).

    owned: (B, N) the cell answers for an object.
    boxes: (B, N, 4) that object's box. score: (B, N, 2) what the classes should say.
    unasked: (B, N) cells on ignored objects that answer for none.
    """

    owned: Tensor
    boxes: Tensor
    score: Tensor
    unasked: Tensor


def seen_labels(labels: BatchLabels, height_px: int, width_px: int) -> BatchLabels:
    """The objects as a picture of that size shows them; those whose foot is outside are not asked for."""
    size = labels.boxes.new_ones(4)
    size[0::2], size[1::2] = width_px, height_px
    boxes = torch.minimum(labels.boxes.clamp(min=0.0), size)
    u = (labels.boxes[..., 0] + labels.boxes[..., 2]) / 2
    inside = (u >= 0) & (u < width_px) & (labels.boxes[..., 3] <= height_px - 1) & (boxes[..., 3] > boxes[..., 1])
    asked = labels.asked & inside
    return replace(labels, boxes=boxes, asked=asked, ignored=(labels.asked | labels.ignored) & ~asked)


def _asked_first(labels: BatchLabels) -> BatchLabels:
    """The first objects of each picture that are asked for, then others, as many as are looked at."""
    order = labels.asked.int().topk(min(MOST_OBJECTS, labels.asked.shape[1]), dim=1).indices
    return BatchLabels(
        boxes=labels.boxes.gather(1, order[..., None].expand(-1, -1, 4)), kinds=labels.kinds.gather(1, order),
        asked=labels.asked.gather(1, order), ignored=labels.ignored.gather(1, order),
    )  # fmt: skip


@torch.no_grad()
def assign(cells: Cells, labels: BatchLabels, params: AssignmentParams) -> Assignment:
    """The cells that answer: the best by score and overlap of those whose centre lies in the object.

    A cell that two objects want answers for the one that it overlaps most.
    """
    unasked = _within(cells, labels.boxes, labels.ignored).any(dim=1)
    labels = _asked_first(labels)
    metric, overlap = _alignment(cells, labels, params)
    top = metric.topk(min(params.candidates, metric.shape[2]), dim=2)
    best = torch.zeros_like(metric, dtype=torch.bool).scatter_(2, top.indices, top.values > 0.0)
    several = best.sum(dim=1, keepdim=True) > 1
    nearest = torch.zeros_like(best).scatter_(1, overlap.argmax(dim=1, keepdim=True), several)
    best = torch.where(several, nearest, best)
    owned, owner = best.any(dim=1), best.float().argmax(dim=1)
    worth = _worth(metric * best, overlap * best)
    kind = functional.one_hot(labels.kinds.gather(1, owner), CLASSES)
    return Assignment(
        owned=owned, boxes=labels.boxes.gather(1, owner[..., None].expand(-1, -1, 4)),
        score=kind * (worth * owned)[..., None],
        unasked=unasked & ~owned,
    )  # fmt: skip


def _worth(aligned: Tensor, overlap: Tensor) -> Tensor:
    """What the score of each cell (B, N) should be: its alignment, so that an object's best cell has its overlap."""
    most = aligned.amax(dim=2, keepdim=True).clamp(min=1e-9)
    return (aligned / most * overlap.amax(dim=2, keepdim=True)).amax(dim=1)


def _alignment(cells: Cells, labels: BatchLabels, params: AssignmentParams) -> tuple[Tensor, Tensor]:
    """Alignment and overlap of objects and cells (B, M, N); 0 where a cell may not answer."""
    allowed = _within(cells, labels.boxes, labels.asked)
    kinds = labels.kinds[..., None].expand(-1, -1, cells.scores.shape[1])
    own = cells.scores.transpose(1, 2).gather(1, kinds)
    overlap = complete_iou(labels.boxes[:, :, None], cells.boxes[:, None]).clamp(min=0.0) * allowed
    return own**params.alpha * overlap**params.beta * allowed + 1e-9 * allowed, overlap


def _within(cells: Cells, boxes: Tensor, mask: Tensor) -> Tensor:
    """Which cells (B, M, N) have their centre in which masked box.

    Objects thinner than a cell count as wide as it, or none would answer for a trunk in the distance.
    """
    middle, half = (boxes[..., :2] + boxes[..., 2:]) / 2, (boxes[..., 2:] - boxes[..., :2]) / 2
    inside = mask[..., None].expand(-1, -1, len(cells.strides))
    for side in range(2):
        away = (cells.centres[:, side] - middle[..., side, None]).abs()
        inside = inside & (away <= torch.maximum(half[..., side, None], cells.strides / 2))
    return inside
