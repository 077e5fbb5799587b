"""A network in the manner of YOLOv8 (nano), from the architecture's description: the published detector of paper B.

Backbone of C2f blocks, SPPF, a neck that goes up and down again, and heads apart for box and class at strides 8, 16
and 32. Boxes are told as distributions over the distances to their four sides (Li et al. 2020). Paper B, Table 2 sets
it beside itself with ResCBAM, ECA, GAM and SA.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn
from torch.nn import functional

from navcore.training.attention import ATTENTION
from navcore.training.model import CLASSES

STRIDES = (8, 16, 32)
# Distances to a box's sides go from 0 to BINS - 1 strides.
BINS = 16


@dataclass(frozen=True, slots=True, kw_only=True)
class YoloNetParams:
    """Paper B does not say where its blocks sit; here, as in the works it names, in the neck.

    Attributes:
    channels: at strides 2 to 32. depths: bottlenecks at strides 4 to 32 of the backbone.
    attention: key of `ATTENTION`, put behind each of the neck's four C2f blocks.
    """

    channels: tuple[int, int, int, int, int] = (16, 32, 64, 128, 256)
    depths: tuple[int, int, int, int] = (1, 2, 2, 1)
    attention: str = "yolov8n"


class Conv(nn.Sequential):
    """Convolution, batch norm, SiLU."""

    def __init__(self, inputs: int, outputs: int, size: int = 3, stride: int = 1) -> None:
        super().__init__(
            nn.Conv2d(inputs, outputs, size, stride, size // 2, bias=False), nn.BatchNorm2d(outputs), nn.SiLU(True)
        )


class Bottleneck(nn.Module):
    """Two 3x3 convolutions, added to the input where `shortcut`."""

    def __init__(self, channels: int, *, shortcut: bool) -> None:
        super().__init__()
        self.change, self.shortcut = nn.Sequential(Conv(channels, channels), Conv(channels, channels)), shortcut

    def forward(self, x: Tensor) -> Tensor:
        changed: Tensor = self.change(x)
        return x + changed if self.shortcut else changed


class C2f(nn.Module):
    """Half of the channels goes through `depth` bottlenecks; every intermediate result is kept."""

    def __init__(self, inputs: int, outputs: int, depth: int, *, shortcut: bool) -> None:
        super().__init__()
        half = outputs // 2
        self.split = Conv(inputs, outputs, 1)
        self.blocks = nn.ModuleList(Bottleneck(half, shortcut=shortcut) for _ in range(depth))
        self.join = Conv((2 + depth) * half, outputs, 1)

    def forward(self, x: Tensor) -> Tensor:
        parts = list(self.split(x).chunk(2, dim=1))
        for block in self.blocks:
            parts.append(block(parts[-1]))
        joined: Tensor = self.join(torch.cat(parts, dim=1))
        return joined


class SPPF(nn.Module):
    """Maxima over 5, 9 and 13 cells beside the input."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.reduce, self.join = Conv(channels, channels // 2, 1), Conv(2 * channels, channels, 1)

    def forward(self, x: Tensor) -> Tensor:
        parts = [self.reduce(x)]
        for _ in range(3):
            parts.append(functional.max_pool2d(parts[-1], 5, 1, 2))
        joined: Tensor = self.join(torch.cat(parts, dim=1))
        return joined


class YoloNet(nn.Module):
    """(B, 3, H, W) BGR, 0 to 1 -> per stride (B, 4 * BINS + 2, H / s, W / s): side distances, then class logits."""

    def __init__(self, params: YoloNetParams = YoloNetParams()) -> None:
        super().__init__()
        c, d, e = params.channels[2:]
        extra = ATTENTION[params.attention]
        self.to_8, self.to_16, self.to_32 = _backbone(params)
        self.up_16 = nn.Sequential(C2f(d + e, d, 1, shortcut=False), extra(d))
        self.up_8 = nn.Sequential(C2f(c + d, c, 1, shortcut=False), extra(c))
        self.down_16, self.down_32 = Conv(c, c, 3, 2), Conv(d, d, 3, 2)
        self.out_16 = nn.Sequential(C2f(c + d, d, 1, shortcut=False), extra(d))
        self.out_32 = nn.Sequential(C2f(d + e, e, 1, shortcut=False), extra(e))
        self.sides = nn.ModuleList(_branch(n, 4 * BINS, 4 * BINS) for n in (c, d, e))
        self.classes = nn.ModuleList(_branch(n, max(c, CLASSES), CLASSES) for n in (c, d, e))
        for branch in self.classes:
            nn.init.constant_(branch[-1].bias, -6.0)  # type: ignore[index]

    def forward(self, image: Tensor) -> tuple[Tensor, ...]:
        x8 = self.to_8(image)
        x16 = self.to_16(x8)
        x32 = self.to_32(x16)
        up16 = self.up_16(torch.cat((_twice(x32), x16), dim=1))
        out8 = self.up_8(torch.cat((_twice(up16), x8), dim=1))
        out16 = self.out_16(torch.cat((self.down_16(out8), up16), dim=1))
        out32 = self.out_32(torch.cat((self.down_32(out16), x32), dim=1))
        features = zip((out8, out16, out32), self.sides, self.classes, strict=True)
        return tuple(torch.cat((sides(x), classes(x)), dim=1) for x, sides, classes in features)


def _backbone(params: YoloNetParams) -> tuple[nn.Sequential, nn.Sequential, nn.Sequential]:
    """From the picture to stride 8, from there to 16, and from there to 32."""
    a, b, c, d, e = params.channels
    n4, n8, n16, n32 = params.depths
    to_4 = (Conv(3, a, 3, 2), Conv(a, b, 3, 2), C2f(b, b, n4, shortcut=True))
    to_8 = nn.Sequential(*to_4, Conv(b, c, 3, 2), C2f(c, c, n8, shortcut=True))
    to_16 = nn.Sequential(Conv(c, d, 3, 2), C2f(d, d, n16, shortcut=True))
    return to_8, to_16, nn.Sequential(Conv(d, e, 3, 2), C2f(e, e, n32, shortcut=True), SPPF(e))


def _branch(inputs: int, inner: int, outputs: int) -> nn.Sequential:
    return nn.Sequential(Conv(inputs, inner), Conv(inner, inner), nn.Conv2d(inner, outputs, 1))


def _twice(x: Tensor) -> Tensor:
    return functional.interpolate(x, scale_factor=2.0, mode="nearest")


def cell_centres(maps: tuple[Tensor, ...]) -> tuple[Tensor, Tensor]:
    """Centres (N, 2) of all cells of the maps, pixels, and their strides (N,)."""
    device, centres, strides = maps[0].device, [], []
    for one, stride in zip(maps, STRIDES, strict=True):
        rows, columns = (torch.arange(n, device=device) for n in one.shape[2:])
        v, u = torch.meshgrid(rows, columns, indexing="ij")
        centres.append((torch.stack((u, v), dim=2).reshape(-1, 2).float() + 0.5) * stride)
        strides.append(torch.full((u.numel(),), float(stride), device=device))
    return torch.cat(centres), torch.cat(strides)


def flattened(maps: tuple[Tensor, ...]) -> tuple[Tensor, Tensor]:
    """Side distributions (B, N, 4, BINS) as logits and class logits (B, N, 2) of all cells."""
    rows = torch.cat([one.flatten(2) for one in maps], dim=2).transpose(1, 2)
    return rows[..., :-CLASSES].reshape(*rows.shape[:2], 4, BINS), rows[..., -CLASSES:]


def corners(sides: Tensor, centres: Tensor, strides: Tensor) -> Tensor:
    """Boxes (B, N, 4), pixels, whose sides lie at the distributions' means from the cells' centres."""
    bins = torch.arange(BINS, dtype=sides.dtype, device=sides.device)
    away = (sides.softmax(dim=3) * bins).sum(dim=3) * strides[:, None]
    return torch.cat((centres - away[..., :2], centres + away[..., 2:]), dim=2)
