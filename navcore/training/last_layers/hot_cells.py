"""The cells of labelled pictures that the head of a `FootNet` can learn from, with what it looks at there.

All but one cell in thirty show nothing and are told so already. What lies under the head does not change while the
head is trained, so it is worked out once.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import torch
from torch import Tensor
from torch.nn import functional

from navcore.training.model import CLASSES, FootNet
from navcore.training.pictures import BatchLabels, Pictures
from navcore.training.targets import targets

BATCH = 16
# What is taken for a foot with less probability is no foot, and need not be told so.
DOUBT = 0.05
# Of the other cells so many of each picture are taken, each for many: nothing may come up there.
OTHERS = 64


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class HotCells:
    """N cells, numbers in half precision.

    Attributes:
        under: (N, C, 3, 3) what the head sees about each.
        heat: (N, 2, n, n), boxes: (N, 2, 4), weight: (N, 2) as in `Targets`, n feet a cell along each side.
        stands_for: (N,) how many cells each stands for.
    """

    under: Tensor
    heat: Tensor
    boxes: Tensor
    weight: Tensor
    stands_for: Tensor

    def __len__(self) -> int:
        return len(self.under)

    def chosen(self, indices: Tensor) -> HotCells:
        """Those cells alone, in single precision."""
        return HotCells(**{name: getattr(self, name)[indices].float() for name in self.__slots__})


@torch.no_grad()
def hot_cells(net: FootNet, pictures: Pictures, seed: int, progress: Callable[[str], None]) -> HotCells:
    """Of all pictures and their mirror images."""
    net.eval().to(memory_format=torch.channels_last)  # type: ignore[call-overload]
    rng, parts = torch.Generator().manual_seed(seed), list[HotCells]()
    for first in range(0, len(pictures), BATCH):
        images, labels = pictures.batch(range(first, min(first + BATCH, len(pictures))))
        parts += [_of_batch(net, *one, rng) for one in _both_ways(images.float() / 255.0, labels)]
        if first // BATCH % 25 == 24:
            progress(f"  looked at {first + BATCH} of {len(pictures)} pictures")
    return HotCells(**{name: torch.cat([getattr(p, name) for p in parts]) for name in HotCells.__slots__})


def _both_ways(images: Tensor, labels: BatchLabels) -> Iterator[tuple[Tensor, BatchLabels]]:
    yield images, labels
    x1, y1, x2, y2 = labels.boxes.unbind(dim=2)
    width = images.shape[3]
    yield images.flip(3), replace(labels, boxes=torch.stack((width - x2, y1, width - x1, y2), dim=2))


def _of_batch(net: FootNet, images: Tensor, labels: BatchLabels, rng: torch.Generator) -> HotCells:
    wanted = targets(labels, images.shape[2], images.shape[3], net.finer)
    under = net.under_head(images.contiguous(memory_format=torch.channels_last))
    told, _ = net.told(under)
    heat, doubt = (_by_cell(values, net.finer) for values in (wanted.heat, told.sigmoid()))
    hot = (heat > 0).any(1) | (wanted.weight > 0).any(1) | ((doubt > DOUBT) & (heat >= 0)).any(1)
    other = ~hot & (torch.rand(hot.shape, generator=rng) * hot[0].numel() < OTHERS)
    picture, row, column = torch.nonzero(hot | other, as_tuple=True)
    place = (picture, slice(None), row, column)
    share = torch.where(other, float(hot[0].numel()) / OTHERS, 1.0)
    return HotCells(
        under=_about(under, picture, row, column).half(),
        boxes=wanted.boxes.permute(0, 3, 4, 1, 2)[picture, row, column].half(),
        heat=heat[place].view(-1, CLASSES, net.finer, net.finer).half(),
        weight=wanted.weight[place].half(),
        stands_for=share[picture, row, column].half(),
    )  # fmt: skip


def _by_cell(values: Tensor, finer: int) -> Tensor:
    """(B, 2, n h, n w) as (B, 2 n^2, h, w)."""
    return functional.pixel_unshuffle(values, finer)


def _about(under: Tensor, picture: Tensor, row: Tensor, column: Tensor) -> Tensor:
    """(N, C, 3, 3) of features (B, C, h, w), nothing beyond their edges."""
    padded = functional.pad(under, (1, 1, 1, 1)).permute(0, 2, 3, 1).contiguous()
    rows = [torch.stack([padded[picture, row + i, column + j] for j in range(3)], dim=2) for i in range(3)]
    return torch.stack(rows, dim=2)
