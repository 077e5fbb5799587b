"""Every sane form of picture becomes the one kind of file that the station serves."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
import rasterio
from rasterio.transform import Affine

from backend.orthophoto_check import CheckParams
from backend.orthophoto_import import import_picture
from tests.backend.pictures import NORTH_UP, colours, write

pytestmark = pytest.mark.filterwarnings("ignore::PendingDeprecationWarning")  # rasterio, of its own affine


def silent(progress: float, message: str) -> None:
    """Tell nobody."""


@pytest.mark.parametrize("kind", ["grey", "palette", "uint16", "alpha", "nodata", "rotated", "geographic"])
def test_every_sane_form_of_picture_becomes_rgb(tmp_path: Path, kind: str) -> None:
    source, target, rgb = tmp_path / "in.tif", tmp_path / "out.tif", colours()
    alpha = np.full((1, 300, 400), 255, np.uint8)
    alpha[:, :100] = 0
    forms: dict[str, Callable[[], object]] = {
        "grey": lambda: write(source, rgb[:1]),
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
