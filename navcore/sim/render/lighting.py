"""Light and lookup tables of a scene, ready for the shading kernel."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.sim.camera_light import LightParams
from navcore.sim.render.buffers import Floats, Floats32, Vector
from navcore.sim.textures.noise import smooth_noise
from navcore.sim.textures.sky import day_sky, night_sky

WHITE = 1.5


class Lighting(NamedTuple):
    """Light of one frame, colours linear red, green, blue.

    Attributes:
        source: x, y, z and 0 for the direction to the sun, 1 for the lamp's place in `map`.
        beam: direction in which the lamp shines.
        direct, ambient, haze: light of sun or lamp, of the sky, and of the air.
        haze_per_m, exposure, noise: as `LightParams`.
        gains: white balance.
        shadows: whether the sun throws any.
    """

    source: tuple[float, float, float, float]
    beam: Vector
    direct: Vector
    ambient: Vector
    haze: Vector
    haze_per_m: float
    exposure: float
    gains: Vector
    noise: float
    shadows: bool


class Tables(NamedTuple):
    """Lookup tables.

    Attributes:
        linear: (256,) sRGB to linear light.
        developed: (4096,) linear light 0 to 1.5 to sRGB with the film's shoulder.
        fog: (2048,) share of haze over optical depth 0 to 8.
        grain: (509, 1021) noise of deviation about 1.
        jitter: (256, 4) two offsets of shadow samples, px.
        sky: (256, 1024, 3) linear panorama.
    """

    linear: Floats32
    developed: NDArray[np.uint8]
    fog: Floats32
    grain: Floats32
    jitter: Floats32
    sky: Floats32


def daylight(light: LightParams) -> Lighting:
    """Sun and sky; the lamp's place is filled in per frame."""
    el = light.sun_elevation
    sun = np.array(
        (math.cos(el) * math.cos(light.sun_azimuth), math.cos(el) * math.sin(light.sun_azimuth), math.sin(el))
    )
    through = 1.0 - 0.97 * min(max(0.0, light.cloud - 0.5) * 2.0, 1.0)
    low = math.exp(-4.0 * el)
    warm = np.array((1.0, 0.95 - 0.16 * low, 0.88 - 0.42 * low))
    ambient = np.array((0.42, 0.47, 0.56)) * (1.0 + 1.5 * max(0.0, light.cloud - 0.5)) * (1.0 - 0.4 * low)
    if light.night:
        sun, through, ambient = np.zeros(3), 0.0, np.array((0.010, 0.011, 0.015))
    return Lighting(
        source=(*vector(sun), 0.0), beam=(0.0, 0.0, 0.0), direct=vector(warm * 2.6 * through),
        ambient=vector(ambient),
        haze=vector(np.array((0.60, 0.67, 0.74)) * (0.01 if light.night else 1.0)), haze_per_m=light.haze_per_m,
        exposure=light.exposure, gains=(light.red_gain, 1.0, light.blue_gain), noise=light.noise,
        shadows=not light.night and through > 0.05,
    )  # fmt: skip


def vector(array: Floats) -> Vector:
    """An array (3,) as plain numbers."""
    return float(array[0]), float(array[1]), float(array[2])


def with_lamp(lighting: Lighting, light: LightParams, place: Vector, forward: Vector) -> Lighting:
    """At night: the robot's lamp at `place`, shining along `forward`."""
    if not light.night:
        return lighting
    colour = vector(np.array((1.0, 0.94, 0.84)) * 45.0 * light.lamp)
    return lighting._replace(source=(*place, 1.0), beam=forward, direct=colour)


def build_tables(light: LightParams) -> Tables:
    """Tables for a light; its seed decides the clouds."""
    rng = np.random.default_rng((light.seed, 19))
    linear = _linear(np.arange(256) / 255.0)
    sky = night_sky(rng) if light.night else day_sky(rng, light.cloud, light.sun_azimuth, light.sun_elevation)
    grain = rng.standard_normal((509, 1021))
    grain = 0.75 * grain + 0.35 * (np.roll(grain, 1, 0) + np.roll(grain, 1, 1))
    angle = rng.permutation(256) / 256.0 * 2 * math.pi
    spot = np.stack((np.cos(angle), np.sin(angle)), axis=1)
    return Tables(
        linear=linear.astype(np.float32), developed=_developed(), fog=_fog(), grain=grain.astype(np.float32),
        jitter=np.column_stack((0.9 * spot, -0.55 * spot)).astype(np.float32),
        sky=np.ascontiguousarray(_linear(sky / 255.0) * 1.05, dtype=np.float32),
    )  # fmt: skip


def ground_noise(seed: int) -> NDArray[np.uint8]:
    """Tileable noise (512, 512), 0 to 255."""
    field = smooth_noise(512, 512, 1.2, np.random.default_rng((seed, 23)))
    return np.asarray(np.clip(0.5 + field * 0.18, 0.0, 1.0) * 255.0, dtype=np.uint8)


def _linear(x: Floats | Floats32) -> Floats:
    return np.asarray(np.where(x < 0.04045, x / 12.92, ((x + 0.055) / 1.055) ** 2.4), dtype=np.float64)


def _developed() -> NDArray[np.uint8]:
    x = np.arange(4096) / 4095.0 * WHITE
    film = (1.0 - np.exp(-1.55 * x)) / (1.0 - math.exp(-1.55 * WHITE))
    srgb = np.where(film < 0.0031308, film * 12.92, 1.055 * film ** (1 / 2.4) - 0.055)
    return np.asarray(np.clip(srgb * 255.0 + 0.5, 0.0, 255.0), dtype=np.uint8)


def _fog() -> Floats32:
    return np.asarray(1.0 - np.exp(-np.arange(2048) / 256.0), dtype=np.float32)
