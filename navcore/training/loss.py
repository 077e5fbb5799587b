"""Loss of the foot detector: a focal loss for where, a weighted L1 for the box."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor


@dataclass(frozen=True, slots=True, kw_only=True)
class LossParams:
    """Weights. The foot counts most: the row fit lives on it.

    Attributes:
        foot, size: of the foot's place and of the logarithms of width and height, beside the focal loss.
        alpha, beta: exponents of the focal loss (Law and Deng 2018, Equation 1: 2 and 4).
    """

    foot: float = 1.0
    size: float = 0.5
    alpha: float = 2.0
    beta: float = 4.0


def focal_loss(logits: Tensor, heat: Tensor, alpha: float, beta: float) -> Tensor:
    """Penalty-reduced focal loss per foot, heat (B, 2, h, w); cells with a heat below 0 are not asked."""
    p = logits.sigmoid().clamp(1e-5, 1 - 1e-5)
    foot = (heat >= 0.999).to(p.dtype)
    asked = (heat >= 0.0).to(p.dtype)
    found = (1 - p) ** alpha * p.log() * foot
    clutter = (1 - heat.clamp(0, 1)) ** beta * p**alpha * (1 - p).log() * (1 - foot) * asked
    return -(found.sum() + clutter.sum()) / foot.sum().clamp(min=1)


def box_loss(boxes: Tensor, wanted: Tensor, weight: Tensor, params: LossParams) -> Tensor:
    """Weighted L1 of the box values (B, 4, h, w), per unit of weight (B, h, w)."""
    per_value = torch.tensor((params.foot, params.foot, params.size, params.size), device=boxes.device)
    error = (boxes - wanted).abs() * weight[:, None] * per_value[:, None, None]
    return error.sum() / weight.sum().clamp(min=1)


def loss(logits: Tensor, boxes: Tensor, heat: Tensor, wanted: Tensor, weight: Tensor, params: LossParams) -> Tensor:
    """Total for a batch."""
    return focal_loss(logits, heat, params.alpha, params.beta) + box_loss(boxes, wanted, weight, params)
