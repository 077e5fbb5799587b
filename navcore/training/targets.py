"""What the network should say for labelled pictures."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor

from navcore.training.model import CLASSES, STRIDE
from navcore.training.pictures import BatchLabels

# Standard deviation of the peak about a foot, in cells of the peak map.
SPREAD_CELLS = 1.0
# Weight of the box values in the cell of an object's foot and around it: in its class's own values, and in the other
# class's, for a detection that gets the class wrong.
WEIGHTS = {"other around": 0.1, "other": 0.3, "around": 0.3, "own": 1.0}


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Targets:
    """Attributes (h = H / 4, w = W / 4).

    heat: (B, 2, n h, n w) 1 at a foot, falling off around it; -1 where nothing is asked (ignored objects).
    boxes: (B, 2, 4, h, w) per class as `FootNet` gives them.
    weight: (B, 2, h, w) of the box values; 0 where no foot is near.
    """

    heat: Tensor
    boxes: Tensor
    weight: Tensor


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Feet:
    """Objects in cells of one size, all (B, M): foot, size, class, the foot's cell, and whether it is asked for."""

    u: Tensor
    v: Tensor
    width: Tensor
    height: Tensor
    kind: Tensor
    row: Tensor
    column: Tensor
    asked: Tensor


def targets(labels: BatchLabels, height_px: int, width_px: int, finer: int = 2) -> Targets:
    """Targets for pictures of that size, multiples of 4, and feet `finer` times as finely told as boxes.

    Feet outside of the picture are not asked for.
    """
    h, w = height_px // STRIDE, width_px // STRIDE
    fine = _feet(labels, STRIDE // finer, finer * h, finer * w)
    heat = _heat(fine, finer * h, finer * w)
    unasked = _masked(
        labels.boxes * (finer / STRIDE), (labels.ignored | labels.asked) & ~fine.asked, finer * h, finer * w
    )
    heat = torch.where(unasked[:, None] & (heat < 0.5), torch.full_like(heat, -1.0), heat)
    return Targets(heat=heat, **_box_values(_feet(labels, STRIDE, h, w), h, w))


def _feet(labels: BatchLabels, cell_px: int, h: int, w: int) -> _Feet:
    """The objects in cells of that size, h x w of them."""
    x1, y1, x2, y2 = (labels.boxes / cell_px).unbind(dim=2)
    u, v = (x1 + x2) / 2, y2
    inside = (v <= h - 0.25) & (v >= 0) & (u >= 0) & (u < w)
    return _Feet(
        u=u, v=v, width=(x2 - x1).clamp(min=0.1), height=(y2 - y1).clamp(min=0.1), kind=labels.kinds,
        row=v.long().clamp(0, h - 1), column=u.long().clamp(0, w - 1), asked=labels.asked & inside,
    )  # fmt: skip


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
    """Box values at a foot's cell and, with less weight, at its neighbours, for its own class and for the other.

    An object's own claim on a cell beats a neighbour's, its class's beats the other's, and the nearer object's the
    farther one's.
    """
    row, column, away = _around(feet, 1, h, w)
    inside = (row >= 0) & (row < h) & (column >= 0) & (column < w) & feet.asked[..., None]
    order, count = feet.v.argsort(dim=1), feet.u.shape[1]
    place = row.clamp(0, h - 1) * w + column.clamp(0, w - 1)
    best = torch.full((len(feet.u), CLASSES * h * w), -1, device=feet.u.device)
    for kind in range(CLASSES):
        level = 2 * (feet.kind == kind).long()[..., None] + (away == 0).long()
        claim = torch.where(inside, order.argsort(dim=1)[..., None] + count * level, torch.full_like(level, -1))
        best = best.scatter_reduce(1, (kind * h * w + place).flatten(1), claim.flatten(1), "amax")
    owner = order.gather(1, best.clamp(min=0) % count)
    share = torch.stack([torch.full((), value, device=best.device) for value in (0.0, *WEIGHTS.values())])
    weight = share[torch.where(best < 0, torch.zeros_like(best), best // count + 1)]
    return {"boxes": _values(feet, owner.view(-1, CLASSES, h, w)), "weight": weight.view(-1, CLASSES, h, w)}


def _values(feet: _Feet, owner: Tensor) -> Tensor:
    """Box values (B, 2, 4, h, w) of the objects that own the cells (B, 2, h, w)."""
    h, w = owner.shape[2:]
    u, v, width, height = (
        value.gather(1, owner.flatten(1)).view(owner.shape) for value in (feet.u, feet.v, feet.width, feet.height)
    )
    middle_u = torch.arange(w, device=u.device) + 0.5
    middle_v = torch.arange(h, device=u.device)[:, None] + 0.5
    return torch.stack((u - middle_u, v - middle_v, width.log(), height.log()), dim=2)
