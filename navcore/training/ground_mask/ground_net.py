"""The net that tells the corridor's ground, pixel by pixel: an encoder, and a decoder with its finer features."""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn

from navcore.training.model import ConvUnit, Merge, stage


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundNetParams:
    """Small, for one core. Attributes: channels: at strides 2, 4, 8, 16 and 32."""

    channels: tuple[int, int, int, int, int] = (16, 24, 32, 48, 64)


class GroundNet(nn.Module):
    """(B, 3, S, S) BGR, 0 to 1, S a multiple of 32 -> logits (B, 1, S, S)."""

    def __init__(self, params: GroundNetParams = GroundNetParams()) -> None:
        super().__init__()
        a, b, c, d, e = params.channels
        self.stride_2, self.stride_4, self.stride_8 = ConvUnit(3, a, 2), stage(a, b, 1), stage(b, c, 1)
        self.stride_16, self.stride_32 = stage(c, d, 1), stage(d, e, 1)
        self.merge_16, self.merge_8, self.merge_4 = Merge(e, d), Merge(d, c), Merge(c, b)
        self.merge_2 = Merge(b, a)
        self.logits = nn.Conv2d(a, 1, 1)

    def forward(self, image: Tensor) -> Tensor:
        x2 = self.stride_2(image)
        x4 = self.stride_4(x2)
        x8 = self.stride_8(x4)
        x16 = self.stride_16(x8)
        x = self.merge_8(self.merge_16(self.stride_32(x16), x16), x8)
        logits = self.logits(self.merge_2(self.merge_4(x, x4), x2))
        return torch.nn.functional.interpolate(logits, scale_factor=2.0, mode="bilinear", align_corners=False)
