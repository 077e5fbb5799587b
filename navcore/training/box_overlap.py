"""How well boxes fit each other, as a loss may know it."""

from __future__ import annotations

import math

import torch
from torch import Tensor


def complete_iou(boxes: Tensor, others: Tensor) -> Tensor:
    """Intersection over union less the distance of the middles and the difference of the shapes; corners (..., 4).

    Zheng et al. 2020, Equations 10 to 12.
    """
    x1, y1, x2, y2 = boxes.unbind(dim=-1)
    u1, v1, u2, v2 = others.unbind(dim=-1)
    iou = intersection_over_union(boxes, others)
    wide, high = torch.maximum(x2, u2) - torch.minimum(x1, u1), torch.maximum(y2, v2) - torch.minimum(y1, v1)
    apart = ((x1 + x2 - u1 - u2) ** 2 + (y1 + y2 - v1 - v2) ** 2) / 4
    shape = 4 / math.pi**2 * (_slant(others) - _slant(boxes)) ** 2
    with torch.no_grad():
        weight = shape / (1.0 - iou + shape).clamp(min=1e-6)
    return iou - apart / (wide**2 + high**2).clamp(min=1e-6) - weight * shape


def intersection_over_union(boxes: Tensor, others: Tensor) -> Tensor:
    """Of boxes given by corners (..., 4), with those in the same place."""
    x1, y1, x2, y2 = boxes.unbind(dim=-1)
    u1, v1, u2, v2 = others.unbind(dim=-1)
    width = (torch.minimum(x2, u2) - torch.maximum(x1, u1)).clamp(min=0)
    height = (torch.minimum(y2, v2) - torch.maximum(y1, v1)).clamp(min=0)
    common = width * height
    areas = _side(x2 - x1) * _side(y2 - y1) + _side(u2 - u1) * _side(v2 - v1)
    return common / (areas - common).clamp(min=1e-6)


def _slant(boxes: Tensor) -> Tensor:
    x1, y1, x2, y2 = boxes.unbind(dim=-1)
    return torch.atan(_side(x2 - x1) / _side(y2 - y1))


def _side(length: Tensor) -> Tensor:
    return length.clamp(min=1e-3)
