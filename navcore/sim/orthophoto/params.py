"""What a made-up orthophoto is like."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class OrthophotoParams:
    """What the picture is like.

    Attributes:
        pixel_m: ground size of a pixel, 0.04 to 0.5.
        margin_m: of ground around the site.
        sun_azimuth: direction to the sun in `map`, rad from east. shadow_per_height: length of shadows.
        seed: of all that is random.
    """

    pixel_m: float = 0.08
    margin_m: float = 18.0
    sun_azimuth: float = -2.2
    shadow_per_height: float = 0.7
    seed: int = 7
