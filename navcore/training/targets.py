"""What the network should say for labelled pictures."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

from navcore.training.model import CLASSES, STRIDE
from navcore.training.pictures import BatchLabels

SPREAD_CELLS = 0.8
NEIGHBOUR_WEIGHT = 0.3


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Targets:
    """Attributes (h = H / 4, w = W / 4).

    heat: (B, 2, h, w) 1 at a foot, falling off around it; -1 where nothing is asked (ignored objects).
    boxes: (B, 4, h, w) as `FootNet` gives them.
    weight: (B, h, w) of the box values; 0 where no foot is near.
    """

    heat: Tensor
    boxes: Tensor
    weight: Tensor


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Feet:
    """Objects in cells, all (B, M): foot, size, class, the foot's cell, and whether it is asked for."""

    u: Tensor
    v: Tensor
    width: Tensor
    height: Tensor
    kind: Tensor
    row: Tensor
    column: Tensor
    asked: Tensor


def targets(labels: BatchLabels, height_px: int, width_px: int) -> Targets:
    """Targets for pictures of that size, multiples of 4. Feet outside of the picture are not asked for."""
    h, w = height_px // STRIDE, width_px // STRIDE
    x1, y1, x2, y2 = (labels.boxes / STRIDE).unbind(dim=2)
    u, v = (x1 + x2) / 2, y2
    inside = (v <= h - 0.25) & (v >= 0) & (u >= 0) & (u < w)
    feet = _Feet(
        u=u, v=v, width=(x2 - x1).clamp(min=0.1), height=(y2 - y1).clamp(min=0.1), kind=labels.kinds,
        row=v.long().clamp(0, h - 1), column=u.long().clamp(0, w - 1), asked=labels.asked & inside,
    )  # fmt: skip
    heat = _heat(feet, h, w)
    unasked = _masked(labels.boxes / STRIDE, (labels.ignored | labels.asked) & ~feet.asked, h, w)
    heat = torch.where(unasked[:, None] & (heat < 0.5), torch.full_like(heat, -1.0), heat)
    return Targets(heat=heat, **_box_values(feet, h, w))


def _masked(boxes: Tensor, mask: Tensor, h: int, w: int) -> Tensor:
    """Cells (B, h, w) around the feet of the masked objects."""
    x1, y1, x2, y2 = (side[..., None] for side in boxes.unbind(dim=2))
    row, column = (torch.arange(n, device=boxes.device) for n in (h, w))
    top = (y1 + 0.7 * (y2 - y1)).floor() - 1
    rows = (row >= top) & (row < y2.floor() + 3) & mask[..., None]
    columns = (column >= x1.floor() - 1) & (column < x2.floor() + 2)
    return torch.einsum("bmh,bmw->bhw", rows.float(), columns.float()) > 0.5


def _around(feet: _Feet, reach: int, h: int, w: int) -> tuple[Tensor, Tensor, Tensor]:
    """Rows and columns of the cells about each foot (B, M, (2 reach + 1)^2), and the squared distance to its own."""
    steps = torch.arange(-reach, reach + 1, device=feet.u.device)
    down, right = (d.reshape(-1) for d in torch.meshgrid(steps, steps, indexing="ij"))
    return feet.row[..., None] + down, feet.column[..., None] + right, (down**2 + right**2).expand(*feet.u.shape, -1)


def _heat(feet: _Feet, h: int, w: int) -> Tensor:
    row, column, away = _around(feet, 2, h, w)
    inside = (row >= 0) & (row < h) & (column >= 0) & (column < w) & feet.asked[..., None]
    fall = torch.exp(away / (-2 * SPREAD_CELLS**2)) * inside
    layer = (torch.arange(len(feet.u), device=fall.device)[:, None] * CLASSES + feet.kind)[..., None]
    cell = (layer * h + row.clamp(0, h - 1)) * w + column.clamp(0, w - 1)
    heat = torch.zeros(len(feet.u) * CLASSES * h * w, device=fall.device)
    return heat.scatter_reduce(0, cell.reshape(-1), fall.reshape(-1), "amax").view(-1, CLASSES, h, w)


def _box_values(feet: _Feet, h: int, w: int) -> dict[str, Tensor]:
    """Box values at a foot's cell and, with less weight, at its neighbours; the nearer object keeps a shared cell."""
    row, column, away = _around(feet, 1, h, w)
    inside = (row >= 0) & (row < h) & (column >= 0) & (column < w) & feet.asked[..., None]
    nearness = feet.v.argsort(dim=1).argsort(dim=1)[..., None] + feet.u.shape[1] * (away == 0)
    claim = torch.where(inside, nearness, torch.full_like(nearness, -1))
    cell = (row.clamp(0, h - 1) * w + column.clamp(0, w - 1)).flatten(1)
    best = torch.full((len(feet.u), h * w), -1, device=claim.device).scatter_reduce(1, cell, claim.flatten(1), "amax")
    owner = feet.v.argsort(dim=1).gather(1, best.clamp(min=0) % feet.u.shape[1])
    u, v, width, height = (
        value.gather(1, owner).view(-1, h, w) for value in (feet.u, feet.v, feet.width, feet.height)
    )
    middle_u, middle_v = torch.arange(w, device=u.device) + 0.5, torch.arange(h, device=u.device)[:, None] + 0.5
    weight = torch.where(best >= feet.u.shape[1], 1.0, NEIGHBOUR_WEIGHT) * (best >= 0)
    taken = (best >= 0).view(-1, 1, h, w)
    boxes = torch.stack((u - middle_u, v - middle_v, width.log(), height.log()), dim=1) * taken
    return {"boxes": boxes, "weight": weight.view(-1, h, w)}
