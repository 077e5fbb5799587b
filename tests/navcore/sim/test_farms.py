"""Made-up farms are farms: closed fences, lanes inside them, rows long enough, an orthophoto that fits."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import rasterio
from pyproj import Transformer
from shapely import LineString, Point, Polygon

from navcore.geometry.geodesy import EnuFrame
from navcore.maps.site_map import SiteMap, ZoneKind
from navcore.sim.demo_farm import demo_farm
from navcore.sim.layouts import scoring_layout, tuning_layout
from navcore.sim.orchard import OrchardParams
from navcore.sim.orthophoto.painter import write_orthophoto
from navcore.sim.orthophoto.params import OrthophotoParams
from navcore.sim.planting import build_orchard

FARMS = [demo_farm(), *map(scoring_layout, range(6)), *map(tuning_layout, range(3))]


def fence(site: SiteMap) -> Polygon:
    return Polygon(next(z.polygon for z in site.zones if z.kind is ZoneKind.KEEP_IN))


@pytest.mark.parametrize("site", FARMS, ids=lambda site: site.name)
def test_lanes_rows_and_warehouse_lie_inside_the_fence(site: SiteMap) -> None:
    area = fence(site)
    assert area.is_valid
    assert all(area.contains(LineString(lane.points).buffer(1.0)) for lane in site.lanes)
    assert all(area.contains(LineString((row.start, row.end))) for row in site.rows)
    assert site.warehouse is not None
    assert area.contains(Point(site.warehouse.x, site.warehouse.y).buffer(2.0))


@pytest.mark.parametrize("site", FARMS, ids=lambda site: site.name)
def test_rows_are_at_least_sixty_metres_long_and_two_and_a_half_wide(site: SiteMap) -> None:
    assert all(LineString((row.start, row.end)).length >= 60.0 for row in site.rows)
    assert all(2.5 <= row.width <= 4.0 for row in site.rows)


@pytest.mark.parametrize("site", FARMS, ids=lambda site: site.name)
def test_every_row_end_touches_a_headland(site: SiteMap) -> None:
    headlands = [Polygon(z.polygon).buffer(0.05) for z in site.zones if z.kind is ZoneKind.HEADLAND]
    ends = [Point(end) for row in site.rows for end in (row.start, row.end)]
    assert all(any(h.contains(end) for h in headlands) for end in ends)


@pytest.mark.parametrize("site", FARMS, ids=lambda site: site.name)
def test_there_is_room_for_the_warehouse_building(site: SiteMap) -> None:
    assert build_orchard(site, OrchardParams()).shed is not None


def test_neighbouring_rows_share_their_line_of_plants() -> None:
    lines = build_orchard(demo_farm(), OrchardParams()).plant_lines
    assert len(lines) == 7 + 7


def test_tuning_and_scoring_farms_are_never_the_same() -> None:
    tuning = {tuning_layout(i).datum.lat_deg for i in range(60)}
    scoring = {scoring_layout(i).datum.lat_deg for i in range(60)}
    assert len(tuning) == len(scoring) == 60
    assert not tuning & scoring


def test_a_farm_is_the_same_for_the_same_index() -> None:
    assert scoring_layout(3) == scoring_layout(3)


@pytest.fixture(scope="module")
def photo(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("photo") / "demo.tif"
    write_orthophoto(demo_farm(), path, OrthophotoParams(pixel_m=0.16))
    return path


def colour_at(photo: Path, x: float, y: float) -> np.ndarray:
    """Mean red, green, blue of 1 m about a place of the demo farm."""
    lat, lon, _ = EnuFrame(demo_farm().datum).to_geodetic(x, y, 0.0)
    with rasterio.open(photo) as source:
        east, north = Transformer.from_crs(4326, source.crs, always_xy=True).transform(lon, lat)
        row, column = source.index(east, north)
        window = rasterio.windows.Window(column - 3, row - 3, 7, 7)
        return np.asarray(source.read(window=window).reshape(3, -1).mean(axis=1))


def test_the_orthophoto_is_a_tiled_geotiff_in_utm_that_covers_the_farm(photo: Path) -> None:
    with rasterio.open(photo) as source:
        assert source.crs.to_epsg() == 32630
        assert source.profile["tiled"]
        assert source.count == 3
        assert source.res == pytest.approx((0.16, 0.16))


def test_the_orthophoto_shows_things_where_the_map_has_them(photo: Path) -> None:
    roof, road = colour_at(photo, -8.5, 0.0), colour_at(photo, 8.0, 0.0)
    assert roof[0] > 1.6 * roof[1]
    assert road.min() > 120.0
    pond = colour_at(photo, 19.7, -3.2)
    assert pond[2] > pond[0]
    row = demo_farm().rows[0]
    (x0, y0), (x1, y1) = row.start, row.end
    across = np.array((-(y1 - y0), x1 - x0)) / 70.0
    alley, plants = [], []
    for t in np.linspace(0.1, 0.9, 30):
        middle = np.array((x0 + t * (x1 - x0), y0 + t * (y1 - y0)))
        alley.append(colour_at(photo, *middle).sum())
        plants.append(colour_at(photo, *(middle + 1.5 * across)).sum())
    assert np.mean(plants) < 0.75 * np.mean(alley)


def test_the_same_seed_paints_the_same_picture(photo: Path, tmp_path: Path) -> None:
    again = tmp_path / "again.tif"
    write_orthophoto(demo_farm(), again, OrthophotoParams(pixel_m=0.16))
    assert again.read_bytes() == photo.read_bytes()
