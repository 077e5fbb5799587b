"""The ground is uneven, and the same for the same seed."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.maps.site_map import SiteMap
from navcore.sim.terrain import Surface, Terrain, TerrainParams


def terrain(farm: SiteMap, seed: int = 1) -> Terrain:
    return Terrain(farm, TerrainParams(), np.random.default_rng(seed))


@pytest.fixture(scope="module")
def tilts_deg(farm: SiteMap) -> np.ndarray:
    """Roll and pitch of a robot put down at 4000 random places, shape (4000, 2)."""
    ground, rng = terrain(farm), np.random.default_rng(0)
    places = rng.uniform((0.0, 0.0, -3.0), (45.0, 66.0, 3.0), (4000, 3))
    return np.degrees([ground.tilt(x, y, yaw, 0.74, 0.70) for x, y, yaw in places.tolist()])


def test_roll_and_pitch_reach_two_degrees_and_stay_below_six(tilts_deg: np.ndarray) -> None:
    assert (np.abs(tilts_deg).max(axis=0) > 2.0).all()
    assert (np.abs(tilts_deg).max(axis=0) < 6.0).all()


def test_the_ground_is_the_same_for_the_same_seed_and_another_for_another(farm: SiteMap) -> None:
    assert terrain(farm).height(12.3, 4.5) == terrain(farm).height(12.3, 4.5)
    assert terrain(farm).height(12.3, 4.5) != terrain(farm, seed=2).height(12.3, 4.5)


def test_driving_uphill_lifts_the_nose_which_is_negative_pitch(farm: SiteMap) -> None:
    ground = terrain(farm)
    rise = ground.height(20.37, 30.0) - ground.height(19.63, 30.0)
    _, pitch = ground.tilt(20.0, 30.0, 0.0, 0.74, 0.001)
    assert np.sign(pitch) == -np.sign(rise)


def test_leaning_right_is_positive_roll(farm: SiteMap) -> None:
    ground = terrain(farm)
    left_above_right = ground.height(20.0, 30.35) - ground.height(20.0, 29.65)
    roll, _ = ground.tilt(20.0, 30.0, 0.0, 0.001, 0.70)
    assert np.sign(roll) == np.sign(left_above_right)


def test_rows_carry_two_ruts(farm: SiteMap) -> None:
    ground = Terrain(farm, TerrainParams(tilt_std_deg=0.0, slope_max_deg=0.0), np.random.default_rng(1))
    middle, rut = ground.height(23.0, 36.0), ground.height(23.55, 36.0)
    assert 0.01 < middle - rut < 0.03


def test_lanes_are_dirt_and_all_four_surfaces_occur(farm: SiteMap) -> None:
    ground, rng = terrain(farm), np.random.default_rng(0)
    assert {ground.surface(x, 0.0) for x in (5.0, 20.0, 40.0)} == {Surface.DIRT}
    spots = rng.uniform((0.0, 3.0), (45.0, 66.0), (2000, 2)).tolist()
    assert {ground.surface(x, y) for x, y in spots} >= {Surface.GRASS, Surface.WET, Surface.SOIL}


def test_far_outside_the_site_the_ground_goes_on(farm: SiteMap) -> None:
    assert np.isfinite(terrain(farm).height(1e6, -1e6))
