"""The detector's network: a small anchor-free net that looks for the feet of trunks and posts.

A foot is where the object meets the ground; the row fit needs nothing else that exactly. So the map's peaks are feet,
not box centres, and the box hangs above its foot. A vine often stands a hand's breadth from a post: so each class has
boxes of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

import torch
from torch import Tensor, nn

# Of the box values, px.
STRIDE = 4
CLASSES = 2
INPUT_HEIGHT_PX, INPUT_WIDTH_PX = 384, 640


@dataclass(frozen=True, slots=True, kw_only=True)
class FootNetParams:
    """Small, because the robot has one core for it. ONNX Runtime pays for channels in multiples of 16.

    Attributes:
        channels: at strides 2, 4, 8, 16 and 32.
        depths: residual convolutions at strides 4, 8, 16 and 32.
        head: channels of the head.
        separable: whether the head looks at each channel by itself before it mixes them, for less time.
        finer: how many feet fit into a cell of the box values along each side.
    """

    channels: tuple[int, int, int, int, int] = (16, 16, 32, 64, 96)
    depths: tuple[int, int, int, int] = (0, 1, 2, 2)
    head: int = 32
    separable: bool = True
    finer: int = 2


# By name: the shipped one, and one that sees a little better and takes half as long again.
NETS = {
    "small": FootNetParams(channels=(8, 16, 32, 64, 96), separable=False, finer=1),
    "large": FootNetParams(channels=(16, 16, 48, 80, 112), depths=(1, 1, 2, 3), head=48),
}


class ConvUnit(nn.Sequential):
    """3x3 convolution, batch norm, ReLU."""

    def __init__(self, inputs: int, outputs: int, stride: int = 1) -> None:
        super().__init__(
            nn.Conv2d(inputs, outputs, 3, stride, 1, bias=False), nn.BatchNorm2d(outputs), nn.ReLU(inplace=True)
        )


class SeparableUnit(nn.Sequential):
    """3x3 convolution of each channel, then a mix of all channels, each with batch norm and ReLU."""

    def __init__(self, inputs: int, outputs: int) -> None:
        super().__init__(
            nn.Conv2d(inputs, inputs, 3, 1, 1, groups=inputs, bias=False), nn.BatchNorm2d(inputs),
            nn.ReLU(inplace=True),
            nn.Conv2d(inputs, outputs, 1, bias=False), nn.BatchNorm2d(outputs), nn.ReLU(inplace=True),
        )  # fmt: skip


class Residual(nn.Module):
    """What a 3x3 convolution adds."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.change = ConvUnit(channels, channels)

    def forward(self, features: Tensor) -> Tensor:
        changed: Tensor = self.change(features)
        return features + changed


def stage(inputs: int, outputs: int, depth: int) -> nn.Sequential:
    """Half the resolution, then `depth` residual convolutions."""
    return nn.Sequential(ConvUnit(inputs, outputs, 2), *(Residual(outputs) for _ in range(depth)))


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
    """(B, 3, H, W) BGR, 0 to 1, H and W multiples of 32 -> logits (B, 2, n H/4, n W/4) and boxes (B, 8, H/4, W/4).

    Logits are for (trunk, post), n is `finer`. The box values of a cell are, in cells of 4 px and first for trunks,
    then for posts: foot u and v from the cell's middle (foot: middle of the box's lower edge), and the logarithms of
    width and height.
    """

    def __init__(self, params: FootNetParams = FootNetParams()) -> None:
        super().__init__()
        a, b, c, d, e = params.channels
        at_4, at_8, at_16, at_32 = params.depths
        self.stride_4 = nn.Sequential(ConvUnit(3, a, 2), stage(a, b, at_4))
        self.stride_8, self.stride_16, self.stride_32 = stage(b, c, at_8), stage(c, d, at_16), stage(d, e, at_32)
        self.merge_16, self.merge_8, self.merge_4 = Merge(e, d), Merge(d, c), Merge(c, b)
        self.head = SeparableUnit(b, params.head) if params.separable else ConvUnit(b, params.head)
        self.finer, self.logits = params.finer, nn.Conv2d(params.head, CLASSES * params.finer**2, 1)
        self.boxes = nn.Conv2d(params.head, CLASSES * 4, 1)
        nn.init.constant_(self.logits.bias, -5.5)  # type: ignore[arg-type]

    def forward(self, image: Tensor) -> tuple[Tensor, Tensor]:
        return self.told(self.under_head(image))

    def under_head(self, image: Tensor) -> Tensor:
        """What the head looks at: features (B, C, H/4, W/4)."""
        x4 = self.stride_4(image)
        x8 = self.stride_8(x4)
        x16 = self.stride_16(x8)
        x16 = self.merge_16(self.stride_32(x16), x16)
        merged: Tensor = self.merge_4(self.merge_8(x16, x8), x4)
        return merged

    def told(self, under: Tensor) -> tuple[Tensor, Tensor]:
        """Logits and boxes by what is under the head."""
        head = self.head(under)
        logits = self.logits(head)
        return torch.nn.functional.pixel_shuffle(logits, self.finer) if self.finer > 1 else logits, self.boxes(head)


def peaks(logits: Tensor) -> Tensor:
    """Probabilities (B, C, h, w), zero where a neighbouring cell of the same class has a higher one."""
    p = logits.sigmoid()
    return p * (p == torch.nn.functional.max_pool2d(p, 3, 1, 1))
