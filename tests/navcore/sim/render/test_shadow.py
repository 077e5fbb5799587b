"""Shadows fall away from the sun and end where the thing that throws them ends."""

from __future__ import annotations

import math

import numpy as np
import pytest

from navcore.maps.site_map import Datum, Plant, PlantKind, SiteMap
from navcore.sim.orchard import OrchardParams
from navcore.sim.planting import build_orchard
from navcore.sim.render.canopy import leaf_cards
from navcore.sim.render.planting import planted
from navcore.sim.render.primitives import into_chunks
from navcore.sim.render.row_light import UNKNOWN_SUN, material_traits, sun_on_row
from navcore.sim.render.shadow import PER_M, Shadow, ShadowMap
from navcore.sim.textures.atlas import Material, build_atlas


def lone_post_shadow(x: float, y: float, azimuth: float, elevation: float) -> Shadow:
    site = SiteMap(
        name="post",
        datum=Datum(lat_deg=0.0, lon_deg=0.0, height_m=0.0),
        plants=(Plant(x=x, y=y, kind=PlantKind.POST),),
    )
    orchard = build_orchard(site, OrchardParams(height=2.0, post_radius=0.1))
    c = math.cos(elevation)
    sun = np.array((c * math.cos(azimuth), c * math.sin(azimuth), math.sin(elevation)))
    return ShadowMap(into_chunks(planted(orchard, leaf_cards(orchard))), build_atlas(orchard), sun).around(x, y)


def sun_share(shadow: Shadow, x: float, y: float, z: float) -> float:
    """Share of the sun that a steel post gets at a place."""
    right = np.full(1, (x - shadow.shear[0] * z - shadow.centre[0]) * PER_M, np.float32)
    left = np.full(1, (y - shadow.shear[1] * z - shadow.centre[1]) * PER_M, np.float32)
    light, depth, height = np.zeros(1, np.float32), np.full(1, 10.0, np.float32), np.full(1, z, np.float32)
    sun_on_row(
        0, shadow, np.zeros((256, 4), np.float32), material_traits((1.0, 2.0)), np.full(1, Material.STEEL, np.int32),
        np.ones((1, 2), np.float32), depth, height, right, left, light,
    )  # fmt: skip
    return float(light[0])


def shaded(shadow: Shadow, x: float, y: float, z: float) -> bool:
    share = sun_share(shadow, x, y, z)
    assert share in (0.0, 1.0)
    return share == 0.0


@pytest.mark.parametrize("azimuth", [0.0, 1.0, -2.5])
@pytest.mark.parametrize("place", [(0.0, 0.0), (-203.3, 77.7)])
def test_a_post_shades_the_ground_away_from_the_sun_as_far_as_it_is_tall(
    azimuth: float, place: tuple[float, float]
) -> None:
    x, y = place
    shadow = lone_post_shadow(x, y, azimuth, math.radians(45))
    c, s = math.cos(azimuth), math.sin(azimuth)
    assert shaded(shadow, x - 1.5 * c, y - 1.5 * s, 0.0)
    assert not shaded(shadow, x - 2.4 * c, y - 2.4 * s, 0.0)
    assert not shaded(shadow, x + 1.5 * c, y + 1.5 * s, 0.0)
    assert not shaded(shadow, x - 1.5 * c - 0.5 * s, y - 1.5 * s + 0.5 * c, 0.0)


def test_what_stands_above_the_shadow_is_lit() -> None:
    shadow = lone_post_shadow(0.0, 0.0, 0.0, math.radians(45))
    assert shaded(shadow, -1.0, 0.0, 0.5)
    assert not shaded(shadow, -1.0, 0.0, 1.3)


def test_nothing_is_known_far_from_the_robot() -> None:
    shadow = lone_post_shadow(0.0, 0.0, 0.0, math.radians(45))
    assert sun_share(shadow, 40.0, 0.0, 0.0) == pytest.approx(UNKNOWN_SUN)
