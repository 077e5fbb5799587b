"""Loss of the foot detector: a focal loss for where, a weighted L1 and the overlap for the box."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

from navcore.training.box_overlap import intersection_over_union
from navcore.training.targets import Targets


@dataclass(frozen=True, slots=True, kw_only=True)
class LossParams:
    """Weights. The foot counts most: the row fit lives on it.

    Attributes:
        foot, size: of the foot's place and of the logarithms of width and height, beside the focal loss.
        overlap: of one less the intersection over union with the true box.
        narrow: boxes below that width count as many times as they are narrower, at most `most`, cells: a pixel more
            or less costs them their overlap.
        confused: of what is told of one class at the foot of an object of the other, beside what is told elsewhere.
        alpha, beta: exponents of the focal loss (Law and Deng 2018, Equation 1: 2 and 4).
    """

    foot: float = 1.0
    size: float = 0.5
    overlap: float = 4.0
    narrow: float = 2.0
    most: float = 3.0
    confused: float = 4.0
    alpha: float = 2.0
    beta: float = 4.0


def focal_loss(logits: Tensor, heat: Tensor, params: LossParams, times: Tensor | float = 1.0) -> Tensor:
    """Penalty-reduced focal loss per foot, heat (B, 2, h, w); cells with a heat below 0 are not asked.

    `times` is how many cells each stands for, where it is no foot's.
    """
    p = logits.sigmoid().clamp(1e-5, 1 - 1e-5)
    foot = (heat >= 0.999).to(p.dtype)
    asked = (heat >= 0.0).to(p.dtype) * times
    confused = 1.0 + (params.confused - 1.0) * ((heat == 0.0) & (heat.flip(1) > 0.0)).to(p.dtype)
    found = (1 - p) ** params.alpha * p.log() * foot
    clutter = (1 - heat.clamp(0, 1)) ** params.beta * p**params.alpha * (1 - p).log() * (1 - foot) * asked * confused
    return -(found.sum() + clutter.sum()) / foot.sum().clamp(min=1)


def box_loss(boxes: Tensor, wanted: Tensor, weight: Tensor, params: LossParams) -> Tensor:
    """Weighted L1 and overlap of the box values (B, 2, 4, h, w), per unit of weight (B, 2, h, w)."""
    u, v, width, height = (boxes - wanted).abs().unbind(dim=2)
    error = params.foot * (u + v) + params.size * (width + height)
    error = error + params.overlap * (1.0 - overlap(boxes, wanted))
    weight = weight * (params.narrow * (-wanted[:, :, 2]).exp()).clamp(1.0, params.most)
    return (error * weight).sum() / weight.sum().clamp(min=1)


def overlap(boxes: Tensor, others: Tensor) -> Tensor:
    """Intersection over union (B, 2, h, w) of box values (B, 2, 4, h, w) that stand in the same cells."""
    return intersection_over_union(_corners(boxes), _corners(others))


def _corners(boxes: Tensor) -> Tensor:
    """(..., 4), the values last."""
    u, v, log_width, log_height = boxes.unbind(dim=2)
    half, height = log_width.clamp(-4, 6).exp() / 2, log_height.clamp(-4, 6).exp()
    return torch.stack((u - half, v - height, u + half, v), dim=-1)


def loss(logits: Tensor, boxes: Tensor, wanted: Targets, params: LossParams) -> Tensor:
    """Total for a batch of the network's outputs."""
    where = focal_loss(logits, wanted.heat, params)
    return where + box_loss(boxes.view_as(wanted.boxes), wanted.boxes, wanted.weight, params)
