"""Pictures as they could also have been: other crops, sizes, sides and lights."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from navcore.training.samples import Image, Labels


@dataclass(frozen=True, slots=True, kw_only=True)
class AugmentParams:
    """How far a picture is changed.

    Attributes:
        width_px, height_px: of the crop, multiples of 32; a part of the picture trains as well for less time.
        foot_share: share of the crops that are laid about an object's foot; the others lie anywhere.
        full_height_px: the network's input height; crops reach as far below the picture as its padding does.
        scale: factor on the size, from 1 / scale to scale.
        gain, gamma: factors on brightness, contrast and each colour; exponent of the tone curve.
        noise: largest deviation of added noise, of 255.
        blur_share: share of the pictures that are blurred a little.
    """

    width_px: int = 256
    height_px: int = 192
    foot_share: float = 0.7
    full_height_px: int = 384
    scale: float = 1.25
    gain: float = 1.3
    gamma: float = 1.4
    noise: float = 8.0
    blur_share: float = 0.2


def augment(image: Image, labels: Labels, params: AugmentParams, rng: np.random.Generator) -> tuple[Image, Labels]:
    """One crop (height_px, width_px, 3) and its labels; boxes may reach out of it."""
    scale = params.scale ** rng.uniform(-1.0, 1.0)
    u0, v0 = _corner(image, labels, scale, params, rng)
    flip = rng.random() < 0.5
    sign, shift = (-scale, params.width_px + u0 - 1) if flip else (scale, -u0)
    warp = np.array([[sign, 0.0, shift], [0.0, scale, -v0]])
    size = (params.width_px, params.height_px)
    crop = np.asarray(cv2.warpAffine(image, warp, size, flags=cv2.INTER_LINEAR), dtype=np.uint8)
    return relight(crop, params, rng), _moved(labels, scale, u0, v0, params.width_px if flip else None)


def _corner(
    image: Image, labels: Labels, scale: float, params: AugmentParams, rng: np.random.Generator
) -> tuple[float, float]:
    """Upper left corner of the crop in the scaled picture: about a foot, or anywhere."""
    room_u = max(image.shape[1] * scale - params.width_px, 1.0)
    room_v = max(max(image.shape[0] * scale, params.full_height_px) - params.height_px, 1.0)
    u0, v0 = rng.uniform(0, room_u), rng.uniform(0, room_v)
    feet = np.flatnonzero(~labels.ignore)
    if len(feet) and rng.random() < params.foot_share:
        x1, _, x2, y2 = labels.boxes[rng.choice(feet)] * scale
        u0 = (x1 + x2) / 2 - params.width_px * rng.uniform(0.1, 0.9)
        v0 = y2 - params.height_px * rng.uniform(0.3, 0.95)
    return float(np.clip(u0, 0, room_u)), float(np.clip(v0, 0, room_v))


def _moved(labels: Labels, scale: float, u0: float, v0: float, mirror_px: int | None) -> Labels:
    boxes = labels.boxes * scale - (u0, v0, u0, v0)
    if mirror_px is not None:
        boxes = np.column_stack((mirror_px - boxes[:, 2], boxes[:, 1], mirror_px - boxes[:, 0], boxes[:, 3]))
    return Labels(boxes=boxes, kinds=labels.kinds, ignore=labels.ignore)


def relight(image: Image, params: AugmentParams, rng: np.random.Generator) -> Image:
    """Another exposure, white balance, tone curve, blur and noise."""
    tone = np.linspace(0.0, 1.0, 256)[:, None] ** (params.gamma ** rng.uniform(-1, 1))
    gain = params.gain ** rng.uniform(-1, 1) * (1 + 0.3 * (params.gain - 1) * rng.uniform(-1, 1, 3))
    table = np.clip(255 * tone * gain, 0, 255).astype(np.uint8)
    changed = np.asarray(cv2.LUT(image, table[:, None, :]), dtype=np.uint8)
    if rng.random() < params.blur_share:
        changed = np.asarray(cv2.GaussianBlur(changed, (0, 0), rng.uniform(0.4, 1.2)), dtype=np.uint8)
    noise = rng.standard_normal(changed.shape[:2], dtype=np.float32) * np.float32(rng.uniform(0.0, params.noise))
    return np.clip(changed + noise[..., None], 0, 255).astype(np.uint8)
