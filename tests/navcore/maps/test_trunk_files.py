"""A trunk map goes out as GeoJSON and comes back the same; a broken file tells all that is wrong."""

from __future__ import annotations

import csv
import io
import json

import pytest

from navcore.errors import SiteError
from navcore.maps.site_map import Datum, Row, SiteMap
from navcore.maps.trunk_export import COLUMNS, trunks_to_csv, trunks_to_geojson
from navcore.maps.trunk_import import import_trunks
from navcore.maps.trunk_map import MappedTrunk, TrunkMap

SITE = SiteMap(
    name="Farm", datum=Datum(lat_deg=31.4, lon_deg=120.9, height_m=8.0),
    rows=(Row(id="r14", name="Row 14", start=(0.0, 0.0), end=(20.0, 0.0)),),
)  # fmt: skip
MAP = TrunkMap(
    trunks=(
        MappedTrunk(id="a-1", x=1.0, y=1.5, std=0.02, diameter=0.11, times_seen=3, sureness=0.9),
        MappedTrunk(id="a-2", x=2.5, y=1.52, std=0.02, diameter=0.08),
        MappedTrunk(id="a-3", x=2.4, y=-1.5, std=0.03, diameter=0.09),
    )
)


def test_geojson_comes_back_within_a_tenth_of_a_millimetre() -> None:
    back = import_trunks(json.loads(json.dumps(trunks_to_geojson(MAP, SITE))), SITE)
    for t, b in zip(MAP.trunks, back.trunks, strict=True):
        assert (b.x, b.y) == pytest.approx((t.x, t.y), abs=1e-4)  # m
        assert (b.id, b.std, b.diameter, b.times_seen, b.sureness) == (
            t.id,
            t.std,
            t.diameter,
            t.times_seen,
            t.sureness,
        )


def test_csv_tells_the_address() -> None:
    rows = list(csv.DictReader(io.StringIO(trunks_to_csv(MAP, SITE))))
    assert tuple(rows[0]) == COLUMNS
    assert [(r["row"], r["side"], r["number"], r["of"]) for r in rows] == [
        ("Row 14", "left", "1", "2"), ("Row 14", "left", "2", "2"), ("Row 14", "right", "1", "1"),
    ]  # fmt: skip


def test_every_reason_comes_at_once() -> None:
    document = trunks_to_geojson(MAP, SITE)
    document["features"][0]["properties"]["diameter"] = -1
    document["features"][1]["properties"]["id"] = "a-3"
    document["features"][2]["geometry"] = {"type": "LineString", "coordinates": [[0, 0], [1, 1]]}
    with pytest.raises(SiteError) as caught:
        import_trunks(document, SITE)
    assert len(caught.value.reasons) == 2
    document["features"][2] = trunks_to_geojson(MAP, SITE)["features"][2]
    with pytest.raises(SiteError, match="used twice"):
        import_trunks(document, SITE)
