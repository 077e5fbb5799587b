"""Sky and far horizon as a panorama."""

from __future__ import annotations

import math

import numpy as np

from navcore.sim.textures.noise import Image, blend, ramp, rgb, smooth_noise

HEIGHT_PX, WIDTH_PX = 256, 1024


def day_sky(rng: np.random.Generator, cloud: float, sun_azimuth: float, sun_elevation: float) -> Image:
    """Panorama (256, 1024, 3), sRGB 0 to 255: row 0 zenith, last row horizon; columns by azimuth from -pi to pi."""
    elevation = np.linspace(math.pi / 2, 0.0, HEIGHT_PX, dtype=np.float32)[:, None]
    azimuth = np.linspace(-math.pi, math.pi, WIDTH_PX, endpoint=False, dtype=np.float32)[None, :]
    low_sun = math.exp(-6.0 * max(sun_elevation, 0.0))
    horizon = rgb(204, 215, 226) * (1 - low_sun) + rgb(238, 206, 168) * low_sun
    shape = np.ones((HEIGHT_PX, WIDTH_PX), dtype=np.float32)
    sky = blend(
        horizon * shape[..., None], rgb(92, 136, 192), np.asarray(np.sin(elevation) ** 0.55 * shape, np.float32)
    )
    noise = smooth_noise(HEIGHT_PX, WIDTH_PX, 1.75, rng, (2.2, 1.0)) - 0.2
    white = rgb(236, 238, 240) - (ramp(noise, 0.8, 2.6) * 46.0)[..., None]
    sky = blend(sky, white, ramp(noise + (cloud - 0.5) * 4.0, 0.0, 1.6) * 0.92)
    sky = sky + _glow(elevation, azimuth, sun_azimuth, sun_elevation)[..., None] * (1.0 - 0.85 * cloud)
    return _with_far_hills(np.clip(sky, 0.0, 255.0), elevation, rng)


def _glow(elevation: Image, azimuth: Image, sun_azimuth: float, sun_elevation: float) -> Image:
    facing = np.sin(elevation) * math.sin(sun_elevation)
    facing = facing + np.cos(elevation) * math.cos(sun_elevation) * np.cos(azimuth - sun_azimuth)
    toward = np.clip(facing, 0.0, 1.0)
    return np.asarray(toward**50 * 90.0 + toward**900 * 400.0, dtype=np.float32)


def night_sky(rng: np.random.Generator) -> Image:
    """Dark panorama (256, 1024, 3) with a faint glow over the horizon."""
    elevation = np.linspace(math.pi / 2, 0.0, HEIGHT_PX, dtype=np.float32)[:, None]
    glow = np.exp(-elevation * 4.0) * np.ones((1, WIDTH_PX), dtype=np.float32)
    sky = blend(rgb(10, 12, 20) * np.ones((HEIGHT_PX, WIDTH_PX, 1), dtype=np.float32), rgb(34, 32, 38), glow)
    return _with_far_hills(sky, elevation, rng, dark=0.25)


def _with_far_hills(sky: Image, elevation: Image, rng: np.random.Generator, dark: float = 1.0) -> Image:
    """Hills and hedges up to about 2 deg over the horizon."""
    ridge = np.abs(smooth_noise(1, WIDTH_PX, 1.3, rng)) * 0.012 + 0.006
    hedge = np.abs(smooth_noise(1, WIDTH_PX, 0.6, rng)) * 0.008 + 0.002
    sky = blend(sky, rgb(132, 146, 152) * dark, (elevation < ridge).astype(np.float32))
    return blend(sky, rgb(92, 106, 88) * dark, (elevation < hedge).astype(np.float32))
