"""Pictures as they could also have been: other crops, sizes, sides and lights. A batch at a time, on any device."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import torch
from torch import Tensor
from torch.nn import functional

from navcore.training.pictures import BatchLabels

# Feet that stand as near to each other are hard to tell apart.
BESIDE_PX = 12.0


@dataclass(frozen=True, slots=True, kw_only=True)
class AugmentParams:
    """How far a picture is changed.

    Attributes:
        width_px, height_px: of the crop, multiples of 32; a part of the picture trains as well for less time.
        foot_share: share of the crops that are laid about an object's foot; the others lie anywhere.
        crowded: how many times as often that is the foot of an object that another stands beside.
        scale: factor on the size, from 1 / scale to scale.
        stretch: factor on the width over that on the height, from 1 / stretch to stretch.
        gain, gamma: factors on brightness, contrast and each colour; exponent of the tone curve.
        fade: largest share of the colours that is taken out.
        noise: largest deviation of added noise, of 1.
        blur_share: share of the pictures that are blurred a little.
    """

    width_px: int = 256
    height_px: int = 192
    foot_share: float = 0.7
    crowded: float = 3.0
    scale: float = 1.3
    stretch: float = 1.1
    gain: float = 1.35
    gamma: float = 1.4
    fade: float = 0.6
    noise: float = 0.035
    blur_share: float = 0.25


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Crop:
    """Where each of B crops comes from, all (B,): pixels of the crop are `scale` times the picture's, less the corner
    (`u0`, `v0`); mirrored where `flip`."""

    scale_u: Tensor
    scale_v: Tensor
    u0: Tensor
    v0: Tensor
    flip: Tensor


def augment(
    images: Tensor, labels: BatchLabels, params: AugmentParams, rng: torch.Generator
) -> tuple[Tensor, BatchLabels]:
    """Crops (B, 3, height_px, width_px), 0 to 1, of pictures (B, 3, H, W) uint8; boxes may reach out of them.

    `rng` must live on the pictures' device.
    """
    crop = random_crop(images.shape[2:], labels, params, rng)
    return relight(cut(images, crop, params), params, rng), moved(labels, crop, params)


def random_crop(size: torch.Size, labels: BatchLabels, params: AugmentParams, rng: torch.Generator) -> Crop:
    """A crop per picture of that size (H, W): about one of its feet, or anywhere."""
    draw = _Draw(rng, len(labels.boxes), labels.boxes.device)
    scale, stretch = draw.factor(params.scale), draw.factor(params.stretch**0.5)
    scale_u, scale_v = scale * stretch, scale / stretch
    room_u = (size[1] * scale_u - params.width_px).clamp(min=0.0)
    room_v = (size[0] * scale_v - params.height_px).clamp(min=0.0)
    foot_u, foot_v, known = _some_foot(labels, draw, params.crowded)
    about = known & (draw.uniform(0.0, 1.0) < params.foot_share)
    u0 = torch.where(about, foot_u * scale_u - params.width_px * draw.uniform(0.1, 0.9), room_u * draw.uniform(0, 1))
    v0 = torch.where(
        about, foot_v * scale_v - params.height_px * draw.uniform(0.3, 0.95), room_v * draw.uniform(0, 1)
    )
    u0, v0 = torch.minimum(u0.clamp(min=0.0), room_u), torch.minimum(v0.clamp(min=0.0), room_v)
    return Crop(scale_u=scale_u, scale_v=scale_v, u0=u0, v0=v0, flip=draw.uniform(0.0, 1.0) < 0.5)


def _some_foot(labels: BatchLabels, draw: _Draw, crowded: float) -> tuple[Tensor, Tensor, Tensor]:
    """Foot (u, v) of one counted object per picture, all (B,), and whether there is one."""
    known = labels.asked.any(dim=1)
    weight = labels.asked * (1.0 + (crowded - 1.0) * _crowded(labels)) + (~known).float()[:, None]
    pick = torch.multinomial(weight, 1, generator=draw.rng)
    box = labels.boxes[torch.arange(len(pick), device=pick.device), pick[:, 0]]
    return (box[:, 0] + box[:, 2]) / 2, box[:, 3], known


def _crowded(labels: BatchLabels) -> Tensor:
    """Which counted objects (B, M) have another's foot beside their own."""
    feet = torch.stack(((labels.boxes[..., 0] + labels.boxes[..., 2]) / 2, labels.boxes[..., 3]), dim=2)
    near = (torch.cdist(feet, feet) < BESIDE_PX) & labels.asked[:, None] & labels.asked[..., None]
    return near.sum(dim=2) > 1


def cut(images: Tensor, crop: Crop, params: AugmentParams) -> Tensor:
    """The crops (B, 3, height_px, width_px), 0 to 1; black beyond the picture."""
    height, width = images.shape[2:]
    sign = 1.0 - 2.0 * crop.flip.float()
    start_u = torch.where(crop.flip, crop.u0 + params.width_px, crop.u0)
    theta = torch.zeros(len(images), 2, 3, device=images.device)
    theta[:, 0, 0] = sign * params.width_px / (crop.scale_u * width)
    theta[:, 0, 2] = theta[:, 0, 0] + 2.0 * start_u / (crop.scale_u * width) - 1.0
    theta[:, 1, 1] = params.height_px / (crop.scale_v * height)
    theta[:, 1, 2] = theta[:, 1, 1] + 2.0 * crop.v0 / (crop.scale_v * height) - 1.0
    size = [len(images), 3, params.height_px, params.width_px]
    grid = functional.affine_grid(theta, size, align_corners=False)
    return functional.grid_sample(images.float(), grid, align_corners=False) / 255.0


def moved(labels: BatchLabels, crop: Crop, params: AugmentParams) -> BatchLabels:
    """The boxes where the crops show them."""
    scale = torch.stack((crop.scale_u, crop.scale_v, crop.scale_u, crop.scale_v), dim=1)[:, None]
    corner = torch.stack((crop.u0, crop.v0, crop.u0, crop.v0), dim=1)[:, None]
    boxes = labels.boxes * scale - corner
    mirrored = torch.stack(
        (params.width_px - boxes[..., 2], boxes[..., 1], params.width_px - boxes[..., 0], boxes[..., 3]), dim=2
    )
    return replace(labels, boxes=torch.where(crop.flip[:, None, None], mirrored, boxes))


def relight(images: Tensor, params: AugmentParams, rng: torch.Generator) -> Tensor:
    """Another exposure, white balance, tone curve, blur, colour and noise of pictures (B, 3, h, w), 0 to 1."""
    draw = _Draw(rng, len(images), images.device)
    gain = torch.stack([draw.factor(1.0 + 0.3 * (params.gain - 1.0)) for _ in range(3)], dim=1)
    gain = (gain * draw.factor(params.gain)[:, None])[:, :, None, None]
    changed = images.clamp(min=1e-4) ** draw.factor(params.gamma)[:, None, None, None] * gain
    fade = draw.uniform(0.0, params.fade)[:, None, None, None]
    changed = changed.lerp(changed.mean(dim=1, keepdim=True), fade)
    changed = changed.lerp(_blurred(changed), draw.chosen(params.blur_share)[:, None, None, None])
    noise = torch.randn(len(images), 1, *images.shape[2:], generator=rng, device=images.device)
    return (changed + noise * draw.uniform(0.0, params.noise)[:, None, None, None]).clamp(0.0, 1.0)


def _blurred(images: Tensor) -> Tensor:
    """Pictures (B, 3, h, w) under a Gaussian of 1 px, dark beyond their edges."""
    for side in (2, 3):
        length = images.shape[side]
        padded = functional.pad(images, (2, 2, 0, 0) if side == 3 else (0, 0, 2, 2))
        near, far = (padded.narrow(side, i, length) + padded.narrow(side, 4 - i, length) for i in (1, 0))
        images = 0.4 * images + 0.24 * near + 0.06 * far
    return images


@dataclass(frozen=True, slots=True)
class _Draw:
    """Random numbers, one per picture."""

    rng: torch.Generator
    count: int
    device: torch.device

    def uniform(self, low: float, high: float) -> Tensor:
        return low + (high - low) * torch.rand(self.count, generator=self.rng, device=self.device)

    def factor(self, largest: float) -> Tensor:
        """From 1 / largest to largest, even in the logarithm."""
        return (math.log(largest) * self.uniform(-1.0, 1.0)).exp()

    def chosen(self, share: float) -> Tensor:
        """A weight from 0 to 1 for that share of the pictures, 0 for the others."""
        return self.uniform(0.0, 1.0) * (self.uniform(0.0, 1.0) < share).float()
