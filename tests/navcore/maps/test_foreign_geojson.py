"""GeoJSON of QGIS, geojson.io, My Maps and others: taken as meant, or refused with what to do."""

from __future__ import annotations

from typing import Any

import pytest

from navcore.errors import SiteError
from navcore.geometry.geodesy import EnuFrame
from navcore.maps.geojson import import_site

LON, LAT = -5.4, 41.49
LINE = [[LON, LAT], [LON + 1e-4, LAT + 1e-3]]
RING = [[[LON, LAT], [LON + 1e-3, LAT], [LON + 1e-3, LAT + 1e-3], [LON, LAT]]]


def item(geometry: str, coordinates: Any, **properties: Any) -> dict[str, Any]:
    return {"type": "Feature", "properties": properties, "geometry": {"type": geometry, "coordinates": coordinates}}


def collection(*features: dict[str, Any], **members: Any) -> dict[str, Any]:
    return {"type": "FeatureCollection", **members, "features": list(features)}


def crs(name: str) -> dict[str, Any]:
    return {"type": "name", "properties": {"name": name}}


def refusal(document: object) -> str:
    with pytest.raises(SiteError) as caught:
        import_site(document)
    (reason,) = caught.value.reasons
    return reason


def test_multi_geometries_of_one_part_are_that_part() -> None:
    """QGIS writes all features of a layer so."""
    parts = collection(
        item("MultiPoint", [[LON, LAT, 712.3]], kind="warehouse"), item("MultiLineString", [LINE], kind="row"),
        item("MultiPolygon", [RING], kind="keep_in"),
    )  # fmt: skip
    plain = collection(
        item("Point", [LON, LAT], kind="warehouse"), item("LineString", LINE, kind="row"),
        item("Polygon", RING, kind="keep_in"),
    )  # fmt: skip
    assert import_site(parts) == import_site(plain)


def test_several_parts_are_to_be_split() -> None:
    reason = refusal(collection(item("MultiLineString", [LINE, LINE], kind="row", name="R1")))
    assert reason.startswith('The geometry of feature 1 ("R1") is a MultiLineString of several parts.')
    assert "Multipart to Singleparts" in reason


def test_a_feature_alone_is_a_file_of_one() -> None:
    assert import_site(item("LineString", LINE, kind="row")).site.rows[0].id == "row-1"


@pytest.mark.parametrize("written", ["keep_out", "Keep-Out", " KEEP OUT "])
def test_a_kind_may_be_written_as_people_write(written: str) -> None:
    (zone,) = import_site(collection(item("Polygon", RING, kind=written))).site.zones
    assert zone.kind == "keep_out"


def test_features_without_a_kind_are_one_reason_that_names_the_kinds() -> None:
    lines = [item("LineString", LINE, name=f"Row {n}", fid=n) for n in range(100)]
    reason = refusal(collection(*lines))
    assert reason.startswith('Feature 1 ("Row 0") and 99 more have no property "kind"')
    assert "row (LineString)" in reason


@pytest.mark.parametrize(
    ("name", "frame"),
    [("urn:ogc:def:crs:OGC:1.3:CRS84", "WGS 84"), ("EPSG:4326", "WGS 84"), ("urn:ogc:def:crs:EPSG::4258", "ETRS89")],
)
def test_the_datum_that_a_file_names_is_kept(name: str, frame: str) -> None:
    assert import_site(collection(item("LineString", LINE, kind="row"), crs=crs(name))).site.datum.frame == frame


def test_metres_are_no_degrees() -> None:
    metres = collection(item("Point", [299454.5, 4596055.0], kind="warehouse"))
    assert refusal(metres).endswith("Export the file as WGS 84 (EPSG:4326).")
    assert "other than WGS 84" in refusal(
        collection(item("Point", [1.0, 2.0]), crs=crs("urn:ogc:def:crs:EPSG::25830"))
    )


def test_a_number_in_quotes_is_called_a_text() -> None:
    assert 'is the text "2.5"; it must be a number' in refusal(
        collection(item("LineString", LINE, kind="row", width="2.5"))
    )


def test_swapped_coordinates_are_told_by_the_place_and_refused_on_a_farm_that_is_there() -> None:
    swapped = collection(item("LineString", [[y, x] for x, y in LINE], kind="row"))
    imported = import_site(swapped)
    assert imported.notes == ("The site lies at 5.39995 S, 41.49050 E, the middle of its features.",)
    with pytest.raises(SiteError, match="longitude comes before latitude"):
        import_site(swapped, datum=import_site(collection(item("LineString", LINE, kind="row"))).site.datum)


def test_positions_are_where_an_independent_ellipsoid_puts_them() -> None:
    """Metres of a degree at that latitude, by the radii of curvature of WGS 84."""
    site = import_site(collection(item("LineString", LINE, kind="row"))).site
    (x0, y0), (x1, y1) = site.rows[0].start, site.rows[0].end
    assert x1 - x0 == pytest.approx(1e-4 * 83_509.0, abs=1e-3)
    assert y1 - y0 == pytest.approx(1e-3 * 111_063.4, abs=1e-3)
    assert EnuFrame(site.datum).to_geodetic(x0, y0, 0.0)[:2] == pytest.approx((LAT, LON), abs=1e-9)
