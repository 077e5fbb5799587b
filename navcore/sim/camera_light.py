"""Light over the orchard and how the camera answers to it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from enum import StrEnum

from navcore.errors import InputError


class LightName(StrEnum):
    """The named lights."""

    NOON = "noon"
    AFTERNOON = "afternoon"
    EVENING = "evening"
    BACKLIT = "backlit"
    OVERCAST = "overcast"
    NIGHT = "night"


@dataclass(frozen=True, slots=True, kw_only=True)
class LightParams:
    """Light and exposure.

    Attributes:
        sun_azimuth: direction to the sun in `map`, rad counter-clockwise from east.
        sun_elevation: rad above the horizon, 0.05 to pi / 2.
        cloud: 0 clear to 1 overcast.
        night: no sun; the robot's own lamp lights the scene.
        lamp: power of that lamp, 0 to 10.
        exposure: factor on the light, 0.05 to 20.
        red_gain, blue_gain: white balance, 0.5 to 2.
        noise: deviation of the sensor's noise at mid grey, share of full scale, 0 to 0.1.
        blur_px: deviation of the lens' blur, 0 to 3.
        haze_per_m: share of light scattered away per metre, 0 to 0.05.
        seed: of clouds and noise; >= 0.
    """

    sun_azimuth: float = 2.0
    sun_elevation: float = 0.9
    cloud: float = 0.35
    night: bool = False
    lamp: float = 1.0
    exposure: float = 0.72
    red_gain: float = 1.0
    blue_gain: float = 1.0
    noise: float = 0.006
    blur_px: float = 0.5
    haze_per_m: float = 0.004
    seed: int = 1

    def __post_init__(self) -> None:
        bounds = {
            "sun_azimuth": (-10.0, 10.0), "sun_elevation": (0.05, math.pi / 2), "cloud": (0.0, 1.0),
            "lamp": (0.0, 10.0), "exposure": (0.05, 20.0), "red_gain": (0.5, 2.0), "blue_gain": (0.5, 2.0),
            "noise": (0.0, 0.1), "blur_px": (0.0, 3.0), "haze_per_m": (0.0, 0.05),
        }  # fmt: skip
        for name, (low, high) in bounds.items():
            if not low <= getattr(self, name) <= high:
                raise InputError(f"The light's {name} must lie between {low:g} and {high:g}.")


_LIGHTS = {
    LightName.NOON: LightParams(sun_azimuth=1.9, sun_elevation=1.1, cloud=0.3),
    LightName.AFTERNOON: LightParams(sun_azimuth=2.5, sun_elevation=0.65, cloud=0.4, exposure=0.78),
    LightName.EVENING: LightParams(sun_azimuth=2.2, sun_elevation=0.2, cloud=0.35, exposure=0.95, red_gain=1.06),
    LightName.BACKLIT: LightParams(sun_azimuth=0.12, sun_elevation=0.3, cloud=0.2, exposure=0.85, haze_per_m=0.007),
    LightName.OVERCAST: LightParams(sun_azimuth=2.0, sun_elevation=0.8, cloud=1.0, exposure=1.05),
    LightName.NIGHT: LightParams(night=True, exposure=1.0, noise=0.016, blue_gain=0.94),
}


def named_light(name: LightName, *, along: float = 0.0, seed: int = 1) -> LightParams:
    """A named light; the sun's azimuth counts from the direction `along` (rad), so that backlit is backlit."""
    light = _LIGHTS[name]
    return replace(light, sun_azimuth=math.remainder(light.sun_azimuth + along, 2 * math.pi), seed=seed)
