"""Height above the ground from above: each thing at its place on the screen, however the ground lies."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.mapping.surface_model import SurfaceModel, SurfaceParams, surface_model
from navcore.mapping.trellis.ground_model import GroundModel
from navcore.maps.site_map import Datum

DATUM = Datum(lat_deg=42.3412, lon_deg=-8.0221, height_m=212.5)
# The same places in ENU and in EPSG:3857, by pyproj; the front end's own way to the screen is held to them too.
PLACES = (
    ((0.0, 0.0), (-893016.0870927199, 5212227.370486376)),
    ((100.0, 0.0), (-892881.0060876404, 5212227.369519377)),
    ((0.0, 100.0), (-893016.0870927199, 5212362.94980905)),
)
HEIGHT = 2.5  # m


def pillars(slope: float) -> np.ndarray:
    """Ground (N, 3) that rises to the east by `slope`, m per m, with a pillar on each place."""
    rng = np.random.default_rng(2)
    xy = np.concatenate([rng.uniform(-6.0, 6.0, (3000, 2)) + place for place, _ in PLACES])
    tops = np.array([place for place, _ in PLACES])
    flat = [np.column_stack((xy, slope * xy[:, 0]))]
    return np.concatenate([*flat, *(np.column_stack((tops, slope * tops[:, 0] + h)) for h in (0.5, 1.5, HEIGHT))])


def surface_of(points: np.ndarray, params: SurfaceParams = SurfaceParams()) -> SurfaceModel:
    return surface_model(points, GroundModel.of([points]), DATUM, params)


def at(surface: SurfaceModel, place: tuple[float, float]) -> float:
    """Height in the pixel of a place in EPSG:3857, m."""
    west, south, east, north = surface.bounds
    rows, columns = surface.heights.shape
    column = int((place[0] - west) / (east - west) * columns)
    row = int((north - place[1]) / (north - south) * rows)
    return float(surface.heights[row, column])


@pytest.mark.parametrize("slope", [0.0, 0.15])
def test_a_thing_is_in_the_pixel_of_its_place_as_high_as_it_stands_above_the_ground(slope: float) -> None:
    surface = surface_of(pillars(slope))
    assert surface.pixel == pytest.approx(0.1)
    for _, place in PLACES:
        assert at(surface, place) == pytest.approx(HEIGHT, abs=0.12)  # m; a cell's ground is one of its low points


def test_pixels_are_square_on_the_ground_and_what_nobody_saw_is_nan() -> None:
    surface = surface_of(pillars(0.0))
    west, south, east, north = surface.bounds
    rows, columns = surface.heights.shape
    assert (east - west) / columns == pytest.approx((north - south) / rows)
    assert columns == pytest.approx(112.0 / surface.pixel, abs=6)  # 112 m from the west of one to the east of another
    assert np.isnan(at(surface, (west + 60.0, south + 60.0)))


def test_a_larger_farm_gets_larger_pixels_and_keeps_all_that_stands_on_it() -> None:
    surface = surface_of(pillars(0.0), SurfaceParams(most=200))
    assert max(surface.heights.shape) <= 200
    assert surface.pixel == pytest.approx(112.0 / 199, rel=0.02)  # m
    for _, place in PLACES:
        assert at(surface, place) == pytest.approx(HEIGHT, abs=0.12)  # m


def test_a_bird_is_not_drawn() -> None:
    bird = np.array([[3.0, 3.0, 60.0]])
    with_bird, without = (surface_of(p) for p in (np.concatenate((pillars(0.0), bird)), pillars(0.0)))
    assert np.nanmax(with_bird.heights) == pytest.approx(np.nanmax(without.heights))


def test_the_ground_is_known_only_where_it_was_seen() -> None:
    ground = GroundModel.of([pillars(0.15)])
    places = np.array([(1.0, 1.0), (100.0, 2.0), (50.0, 50.0), (-40.0, 0.0), (1e6, 1e6)])
    heights = ground.seen_height(places)
    assert heights[:2] == pytest.approx(0.15 * places[:2, 0], abs=0.12)  # m
    assert np.isnan(heights[2:]).all()
