"""The detector's network: a small anchor-free net that looks for the feet of trunks and posts.

A foot is where the object meets the ground; the row fit needs nothing else that exactly. So the map's peaks are feet,
not box centres, and the box hangs above its foot.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn

STRIDE = 4
CLASSES = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class FootNetParams:
    """Channels at strides 2, 4, 8, 16 and 32, and of the head. Small, because the robot has one core for it."""

    channels: tuple[int, int, int, int, int] = (16, 16, 48, 64, 96)
    head: int = 32


class ConvUnit(nn.Sequential):
    """3x3 convolution, batch norm, ReLU."""

    def __init__(self, inputs: int, outputs: int, stride: int = 1) -> None:
        super().__init__(
            nn.Conv2d(inputs, outputs, 3, stride, 1, bias=False), nn.BatchNorm2d(outputs), nn.ReLU(inplace=True)
        )


class Merge(nn.Module):
    """Coarse features brought up by two and added to the fine ones."""

    def __init__(self, coarse: int, fine: int) -> None:
        super().__init__()
        self.reduce = nn.Conv2d(coarse, fine, 1)
        self.up = nn.Upsample(scale_factor=2.0, mode="nearest")
        self.smooth = ConvUnit(fine, fine)

    def forward(self, coarse: Tensor, fine: Tensor) -> Tensor:
        merged: Tensor = self.smooth(fine + self.up(self.reduce(coarse)))
        return merged


class FootNet(nn.Module):
    """(B, 3, H, W) BGR, 0 to 1, H and W multiples of 32 -> logits (B, 2, H/4, W/4) and boxes (B, 4, H/4, W/4).

    Logits are for (trunk, post). The box values of a cell are, in cells of 4 px: foot u and v from the cell's middle
    (foot: middle of the box's lower edge), and the logarithms of width and height.
    """

    def __init__(self, params: FootNetParams = FootNetParams()) -> None:
        super().__init__()
        a, b, c, d, e = params.channels
        self.stride_4 = nn.Sequential(ConvUnit(3, a, 2), ConvUnit(a, b, 2), ConvUnit(b, b))
        self.stride_8 = nn.Sequential(ConvUnit(b, c, 2), ConvUnit(c, c), ConvUnit(c, c))
        self.stride_16 = nn.Sequential(ConvUnit(c, d, 2), ConvUnit(d, d))
        self.stride_32 = nn.Sequential(ConvUnit(d, e, 2), ConvUnit(e, e))
        self.merge_16, self.merge_8, self.merge_4 = Merge(e, d), Merge(d, c), Merge(c, b)
        self.head = ConvUnit(b, params.head)
        self.logits = nn.Conv2d(params.head, CLASSES, 1)
        self.boxes = nn.Conv2d(params.head, 4, 1)
        nn.init.constant_(self.logits.bias, -4.6)  # type: ignore[arg-type]

    def forward(self, image: Tensor) -> tuple[Tensor, Tensor]:
        x4 = self.stride_4(image)
        x8 = self.stride_8(x4)
        x16 = self.stride_16(x8)
        x16 = self.merge_16(self.stride_32(x16), x16)
        head = self.head(self.merge_4(self.merge_8(x16, x8), x4))
        return self.logits(head), self.boxes(head)


def peaks(logits: Tensor) -> Tensor:
    """Probabilities (B, C, h, w), zero where a neighbouring cell of the same class has a higher one."""
    p = logits.sigmoid()
    return p * (p == torch.nn.functional.max_pool2d(p, 3, 1, 1))
