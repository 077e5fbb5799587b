"""Every sane form of picture becomes the one kind of file that the station serves."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pyproj
import pytest
import rasterio
from rasterio.transform import Affine

from backend.orthophoto_check import CheckParams
from backend.orthophoto_datum import frame_of, name_of
from backend.orthophoto_import import import_picture
from tests.backend.pictures import NORTH_UP, colours, write

pytestmark = pytest.mark.filterwarnings("ignore::PendingDeprecationWarning")  # rasterio, of its own affine


def silent(progress: float, message: str) -> None:
    """Tell nobody."""


KINDS = (
    "grey", "white is zero", "palette", "uint16", "4 bits", "named bands", "alpha", "nodata", "rotated", "geographic",
)  # fmt: skip


@pytest.mark.parametrize("kind", KINDS)
def test_every_sane_form_of_picture_becomes_rgb(tmp_path: Path, kind: str) -> None:
    source, target, rgb = tmp_path / "in.tif", tmp_path / "out.tif", colours()
    alpha = np.full((1, 300, 400), 255, np.uint8)
    alpha[:, :100] = 0
    forms: dict[str, Callable[[], object]] = {
        "grey": lambda: write(source, rgb[:1]),
        "white is zero": lambda: write(source, 255 - rgb[:1], photometric="MINISWHITE"),
        "4 bits": lambda: write(source, rgb[:1] // 16, nbits=4),
        "named bands": lambda: write(source, np.concatenate([rgb[::-1], alpha]), photometric="MINISBLACK"),
        "palette": lambda: write(source, rgb[:1] // 200),
        "uint16": lambda: write(source, rgb.astype(np.uint16) * 20),
        "alpha": lambda: write(source, np.concatenate([rgb, alpha]), photometric="RGB", alpha="YES"),
        "nodata": lambda: write(source, np.where(alpha > 0, np.maximum(rgb, 1), 0).astype(np.uint8), nodata=0),
        "rotated": lambda: write(source, rgb, transform=NORTH_UP @ Affine.rotation(30.0)),
        "geographic": lambda: write(source, rgb, crs="EPSG:4326", transform=Affine(3e-6, 0, -5.4, 0, -3e-6, 41.5)),
    }
    forms[kind]()
    if kind == "palette":
        with rasterio.open(source, "r+") as out:
            out.write_colormap(1, {0: (0, 200, 0, 255), 1: (200, 0, 0, 255)})
    if kind == "named bands":
        with rasterio.open(source, "r+") as out:
            out.descriptions = ("Blue", "Green", "Red", "NIR")
    import_picture(source, target, CheckParams(), silent)
    with rasterio.open(target) as made:
        assert (made.count, made.dtypes[0], made.block_shapes[0]) == (3, "uint8", (512, 512))
        assert made.transform.b == 0.0
        assert made.transform.e < 0.0
        mask, red = made.dataset_mask(), made.read(1)
    shown = float((mask > 0).mean())
    expected = {"alpha": 2 / 3, "nodata": 2 / 3}.get(kind, 1.0)
    assert 0.3 < shown < 0.9 if kind == "rotated" else shown == pytest.approx(expected, abs=0.01)
    if kind != "rotated":
        assert int(red[200, 50]) > 150
        assert int(red[200, 350]) < 60 or kind == "nodata"


def test_a_palette_that_is_turned_upright_keeps_its_colours(tmp_path: Path) -> None:
    """Red is 1, green is 9, and blue all that lies between."""
    checks = (np.indices((300, 400)).sum(axis=0) // 20 % 2 * 8 + 1)[None].astype(np.uint8)
    source = write(tmp_path / "in.tif", checks, transform=NORTH_UP @ Affine.rotation(30.0))
    with rasterio.open(source, "r+") as out:
        blue = dict.fromkeys(range(256), (0, 0, 255, 255))
        out.write_colormap(1, blue | {1: (255, 0, 0, 255), 9: (0, 255, 0, 255)})
    import_picture(source, tmp_path / "out.tif", CheckParams(), silent)
    with rasterio.open(tmp_path / "out.tif") as made:
        seen = made.read(3)[made.dataset_mask() > 0]
    assert (seen > 200).mean() < 0.001


def marked(column: int, row: int) -> np.ndarray[Any, Any]:
    """Black, with a white square of 9 pixels around one of them."""
    picture = np.zeros((3, 300, 400), np.uint8)
    picture[:, row - 4 : row + 5, column - 4 : column + 5] = 255
    return picture


PLACED: dict[str, dict[str, Any]] = {
    "north up": {},
    "turned": {"transform": NORTH_UP @ Affine.rotation(30.0)},
    "mirrored": {"transform": NORTH_UP @ Affine.scale(-1.0, 1.0)},
    "south up": {"transform": NORTH_UP @ Affine.scale(1.0, -1.0)},
    "degrees": {"crs": "EPSG:4326", "transform": Affine(3e-6, 0, -5.4, 0, -2.25e-6, 41.5)},
    "web map": {"crs": "EPSG:3857", "transform": Affine(0.25, 0, -601391.9, 0, -0.25, 5085049.7)},
    "survey feet": {"crs": "EPSG:2229", "transform": Affine(0.8, 0, 6450000.0, 0, -0.8, 1850000.0)},
    "with heights": {"crs": "EPSG:25830+5782"},
}


@pytest.mark.parametrize("kind", PLACED)
def test_what_is_seen_stays_where_it_is_on_the_ground(tmp_path: Path, kind: str) -> None:
    """Latitude and longitude of a mark, before the import and in its result: less than half a pixel apart."""
    source = write(tmp_path / "in.tif", marked(300, 80), **PLACED[kind])
    facts = import_picture(source, tmp_path / "out.tif", CheckParams(), silent)
    with rasterio.open(source) as before, rasterio.open(tmp_path / "out.tif") as after:
        wanted = before.transform @ (300.5, 80.5)
        rows, columns = np.nonzero(after.read(2) > 128)
        found = after.transform @ (float(columns.mean()) + 0.5, float(rows.mean()) + 0.5)
        to_degrees = pyproj.Transformer.from_crs(before.crs, "EPSG:4326", always_xy=True)
        (lon, lat), (lon_found, lat_found) = to_degrees.transform(*wanted), to_degrees.transform(*found)
    off = pyproj.Geod(ellps="WGS84").inv(lon, lat, lon_found, lat_found)[2]
    assert off < 0.5 * facts.resolution
    west, south, east, north = facts.bounds_deg
    assert west < lon < east
    assert south < lat < north


@pytest.mark.parametrize(
    ("system", "place", "frame", "told"),
    [
        ("EPSG:25830", (-5.4, 41.5), "ETRS89", "EPSG:25830"),
        ("EPSG:2154", (2.0, 46.0), "ETRS89", "EPSG:2154"),
        ("EPSG:32630", (-5.4, 41.5), "WGS 84", "EPSG:32630"),
        ("EPSG:27700", (-1.0, 52.0), "WGS 84", "EPSG:27700 (its place is known to 2 m)"),
        ("EPSG:4214", (116.0, 40.0), "WGS 84", "EPSG:4214 (taken as WGS 84: how the two differ is not known)"),
    ],
)
def test_the_datum_is_named_and_a_way_that_is_not_exact_is_told(
    system: str, place: tuple[float, float], frame: str, told: str
) -> None:
    crs = pyproj.CRS(system)
    x, y = pyproj.Transformer.from_crs("EPSG:4326", crs, always_xy=True).transform(*place)
    assert (frame_of(crs, x, y), name_of(crs, x, y)) == (frame, told)
