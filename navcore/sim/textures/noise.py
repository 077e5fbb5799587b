"""Random fields and colour mixing for textures. Colours are sRGB, 0 to 255, channels red, green, blue."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Image = NDArray[np.float32]


def rgb(red: float, green: float, blue: float) -> Image:
    """A colour as array (3,)."""
    return np.array((red, green, blue), dtype=np.float32)


def smooth_noise(
    height: int, width: int, slope: float, rng: np.random.Generator, stretch: tuple[float, float] = (1.0, 1.0)
) -> Image:
    """Tileable noise (height, width), spectrum 1 / f^slope, mean 0, deviation 1; `stretch` is for y and x."""
    fy = np.fft.fftfreq(height)[:, None] * height * stretch[0]
    fx = np.fft.fftfreq(width)[None, :] * width * stretch[1]
    frequency = np.sqrt(fx * fx + fy * fy)
    frequency[0, 0] = 1.0
    spectrum = np.fft.fft2(rng.standard_normal((height, width))) / frequency**slope
    spectrum[0, 0] = 0.0
    field = np.real(np.fft.ifft2(spectrum))
    return np.asarray(field / field.std(), dtype=np.float32)


def blend(a: Image, b: Image, share: Image) -> Image:
    """`a` where share (H, W) is 0, `b` where it is 1."""
    return np.asarray(a * (1.0 - share[..., None]) + b * share[..., None], dtype=np.float32)


def ramp(x: Image, low: float, high: float) -> Image:
    """0 below low, 1 above high, smooth between."""
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t), dtype=np.float32)


def finished(image: Image, alpha: NDArray[np.uint8] | None = None) -> NDArray[np.uint8]:
    """Texels (H, W, 4) uint8 of a colour picture (H, W, 3) and its alpha (H, W), opaque without one."""
    colour = np.clip(image, 0.0, 255.0).astype(np.uint8)
    opaque = np.full(colour.shape[:2], 255, dtype=np.uint8) if alpha is None else alpha
    return np.dstack((colour, opaque))
