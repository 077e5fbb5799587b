"""The attention modules of paper B's comparison (Table 2), from their own descriptions. Each keeps the shape."""

from __future__ import annotations

import math
from collections.abc import Callable

import torch
from torch import Tensor, nn


class ECA(nn.Module):
    """Efficient channel attention (Wang et al. 2020): a convolution over neighbouring channels' means."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        size = int(abs(math.log2(channels) / 2 + 0.5)) | 1
        self.mix = nn.Conv1d(1, 1, size, padding=size // 2, bias=False)

    def forward(self, x: Tensor) -> Tensor:
        mean = x.mean(dim=(2, 3))[:, None]
        weight: Tensor = self.mix(mean).sigmoid()[:, 0, :, None, None]
        return x * weight


class ChannelGate(nn.Module):
    """Of CBAM (Woo et al. 2018, Equation 2): one small network on the means and the maxima of the channels."""

    def __init__(self, channels: int, reduction: int = 16) -> None:
        super().__init__()
        inner = max(channels // reduction, 4)
        self.network = nn.Sequential(nn.Linear(channels, inner), nn.ReLU(inplace=True), nn.Linear(inner, channels))

    def forward(self, x: Tensor) -> Tensor:
        weight: Tensor = (self.network(x.mean(dim=(2, 3))) + self.network(x.amax(dim=(2, 3)))).sigmoid()
        return x * weight[..., None, None]


class SpatialGate(nn.Module):
    """Of CBAM (Equation 3): a 7 x 7 convolution on the mean and the maximum over the channels."""

    def __init__(self) -> None:
        super().__init__()
        self.mix = nn.Conv2d(2, 1, 7, padding=3, bias=False)

    def forward(self, x: Tensor) -> Tensor:
        weight: Tensor = self.mix(torch.cat((x.mean(dim=1, keepdim=True), x.amax(dim=1, keepdim=True)), dim=1))
        return x * weight.sigmoid()


class ResCBAM(nn.Module):
    """Two convolutions and CBAM as what is added to the input (Ju et al. 2024)."""

    def __init__(self, channels: int) -> None:
        super().__init__()
        self.change = nn.Sequential(
            nn.Conv2d(channels, channels, 3, 1, 1, bias=False), nn.BatchNorm2d(channels), nn.ReLU(inplace=True),
            nn.Conv2d(channels, channels, 3, 1, 1, bias=False), nn.BatchNorm2d(channels),
            ChannelGate(channels), SpatialGate(),
        )  # fmt: skip

    def forward(self, x: Tensor) -> Tensor:
        changed: Tensor = self.change(x)
        return torch.relu(x + changed)


class GAM(nn.Module):
    """Global attention (Liu et al. 2021): channels mixed at each place, then places by two 7 x 7 convolutions."""

    def __init__(self, channels: int, reduction: int = 4) -> None:
        super().__init__()
        inner = channels // reduction
        self.channels = nn.Sequential(nn.Linear(channels, inner), nn.ReLU(inplace=True), nn.Linear(inner, channels))
        self.places = nn.Sequential(
            nn.Conv2d(channels, inner, 7, padding=3), nn.BatchNorm2d(inner), nn.ReLU(inplace=True),
            nn.Conv2d(inner, channels, 7, padding=3), nn.BatchNorm2d(channels),
        )  # fmt: skip

    def forward(self, x: Tensor) -> Tensor:
        weight: Tensor = self.channels(x.permute(0, 2, 3, 1)).permute(0, 3, 1, 2)
        x = x * weight.sigmoid()
        places: Tensor = self.places(x)
        return x * places.sigmoid()


class SA(nn.Module):
    """Shuffle attention (Zhang and Yang 2021): of a group of channels half are weighed as wholes, half by place."""

    def __init__(self, channels: int, groups: int = 8) -> None:
        super().__init__()
        self.groups, half = groups, channels // (2 * groups)
        self.channel_scale = nn.Parameter(torch.zeros(1, half, 1, 1))
        self.channel_shift = nn.Parameter(torch.ones(1, half, 1, 1))
        self.place_scale = nn.Parameter(torch.zeros(1, half, 1, 1))
        self.place_shift = nn.Parameter(torch.ones(1, half, 1, 1))
        self.norm = nn.GroupNorm(half, half)

    def forward(self, x: Tensor) -> Tensor:
        b, c, h, w = x.shape
        whole, place = x.reshape(b * self.groups, c // self.groups, h, w).chunk(2, dim=1)
        mean = whole.mean(dim=(2, 3), keepdim=True)
        whole = whole * (self.channel_scale * mean + self.channel_shift).sigmoid()
        place = place * (self.place_scale * self.norm(place) + self.place_shift).sigmoid()
        mixed = torch.cat((whole, place), dim=1).reshape(b, 2, c // 2, h, w)
        return mixed.transpose(1, 2).reshape(b, c, h, w)


# By name, as paper B compares them; `yolov8n` has none.
ATTENTION: dict[str, Callable[[int], nn.Module]] = {
    "yolov8n": lambda _: nn.Identity(), "rescbam": ResCBAM, "eca": ECA, "gam": GAM, "sa": SA,
}  # fmt: skip
