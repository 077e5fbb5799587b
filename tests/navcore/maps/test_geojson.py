"""Sites and missions go out and come back; whatever is broken is refused whole, with every reason."""

from __future__ import annotations

import copy
import json
import math
from collections.abc import Callable
from contextlib import suppress
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.errors import MissionError, SiteError
from navcore.geometry.geodesy import EnuFrame
from navcore.maps.geojson import (
    import_site,
    mission_from_geojson,
    mission_to_geojson,
    site_to_geojson,
)
from navcore.maps.mission import Mission, RowExit, RowVisit, Waypoint
from navcore.maps.site_map import (
    Datum,
    Lane,
    Plant,
    PlantKind,
    Row,
    SiteMap,
    Warehouse,
    Zone,
    ZoneKind,
)

SITE = SiteMap(
    name="Hillside", datum=Datum(lat_deg=41.5, lon_deg=2.1, height_m=312.5, frame="ETRS89", corrections="CatNet"),
    warehouse=Warehouse(x=-27.123, y=-15.5, yaw=1.25, name="Shed"),
    lanes=(Lane(id="road", points=((-24.0, -20.0), (-20.0, -6.0), (812.25, -5.0)), width=3.5, speed=1.1, name="R"),),
    rows=(Row(id="R1", start=(0.0, 0.0), end=(3.0, 60.0), width=2.4, speed=0.5, name="One", post_spacing=5.5),),
    zones=(
        Zone(id="k", kind=ZoneKind.KEEP_OUT, polygon=((5.0, 5.0), (9.0, 5.0), (9.0, 9.0)), name="Pond"),
        Zone(id="h", kind=ZoneKind.HEADLAND, polygon=((0.0, 60.0), (9.0, 60.0), (9.0, 66.0), (0.0, 66.0))),
    ),
    plants=(Plant(x=1.2, y=3.4, kind=PlantKind.TRUNK),),
)  # fmt: skip
MISSION = Mission(
    id="m1", name="Both rows", outbound=(Waypoint(x=-20.0, y=-6.0, speed=0.7), Waypoint(x=1.0, y=-5.0)),
    visits=(RowVisit(row_id="R1", from_start=False, exit=RowExit.THROUGH, speed=0.4),),
    inbound=(Waypoint(x=-5.0, y=70.0),),
)  # fmt: skip


def assert_same(a: Any, b: Any, path: str = "") -> None:
    """Equal, numbers to 0.1 mm."""
    if isinstance(a, float):
        assert b == pytest.approx(a, abs=1e-4), path
    elif isinstance(a, tuple):
        assert len(a) == len(b), path
        for i, (x, y) in enumerate(zip(a, b, strict=True)):
            assert_same(x, y, f"{path}[{i}]")
    elif hasattr(a, "__dataclass_fields__"):
        for name in a.__dataclass_fields__:
            assert_same(getattr(a, name), getattr(b, name), f"{path}.{name}")
    else:
        assert a == b, path


def test_a_site_comes_back_to_within_a_tenth_of_a_millimetre() -> None:
    text = json.dumps(site_to_geojson(SITE), allow_nan=False)
    assert_same(SITE, import_site(json.loads(text)).site)


def test_a_mission_comes_back() -> None:
    text = json.dumps(mission_to_geojson(MISSION, SITE), allow_nan=False)
    assert_same(MISSION, mission_from_geojson(json.loads(text), SITE))


def test_exported_positions_are_wgs_84_with_longitude_first_and_rings_are_closed_counter_clockwise() -> None:
    clockwise = Zone(id="c", kind=ZoneKind.KEEP_IN, polygon=((0.0, 0.0), (0.0, 9.0), (9.0, 9.0)))
    document = site_to_geojson(SiteMap(name="n", datum=SITE.datum, zones=(clockwise,)))
    ring = document["features"][0]["geometry"]["coordinates"][0]
    assert ring[0] == ring[-1]
    assert ring[0] == pytest.approx([2.1, 41.5])
    area = sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in pairwise(ring))
    assert area > 0.0


@given(st.floats(-3000.0, 3000.0), st.floats(-3000.0, 3000.0))
def test_every_place_of_a_large_farm_survives(x: float, y: float) -> None:
    site = SiteMap(name="s", datum=SITE.datum, warehouse=Warehouse(x=x, y=y, yaw=0.0))
    back = import_site(site_to_geojson(site)).site.warehouse
    assert back is not None
    assert math.dist((back.x, back.y), (x, y)) < 1e-3


def broken(change: Callable[[dict[str, Any]], None]) -> str:
    document = copy.deepcopy(site_to_geojson(SITE))
    change(document)
    with pytest.raises(SiteError) as caught:
        import_site(document)
    assert caught.value.reasons
    return str(caught.value)


def feature(document: dict[str, Any], kind: str) -> dict[str, Any]:
    return next(f for f in document["features"] if f["properties"]["kind"] == kind)


@pytest.mark.parametrize("bad", [math.nan, math.inf, "2.1", None, True, 10**400, 181.0])
def test_coordinates_that_are_no_numbers_are_refused(bad: object) -> None:
    def change(document: dict[str, Any]) -> None:
        feature(document, "row")["geometry"]["coordinates"][0][0] = bad

    assert "finite numbers" in broken(change)


@pytest.mark.parametrize(
    ("kind", "name", "bad"),
    [("row", "width", math.nan), ("row", "width", -2.0), ("lane", "speed", "fast"),
     ("warehouse", "yaw_deg", math.inf), ("lane", "name", 7), ("plant", "plant", "tree"),
     ("row", "speed", 10**400), ("row", "kind", "street")],
)  # fmt: skip
def test_properties_out_of_bounds_are_refused_by_name(kind: str, name: str, bad: object) -> None:
    assert f'"{name}" of feature' in broken(lambda d: feature(d, kind)["properties"].update({name: bad}))


def test_a_polygon_that_crosses_itself_is_refused() -> None:
    def change(document: dict[str, Any]) -> None:
        ring = feature(document, "headland")["geometry"]["coordinates"][0]
        ring[1], ring[2] = ring[2], ring[1]

    assert "crosses itself" in broken(change)


def test_open_rings_holes_wrong_shapes_and_far_features_are_refused() -> None:
    def open_ring(document: dict[str, Any]) -> None:
        feature(document, "headland")["geometry"]["coordinates"][0].pop()

    def hole(document: dict[str, Any]) -> None:
        rings = feature(document, "headland")["geometry"]["coordinates"]
        rings.append(rings[0])

    def swapped(document: dict[str, Any]) -> None:
        feature(document, "warehouse")["geometry"]["coordinates"].reverse()

    assert "last equal to the first" in broken(open_ring)
    assert "holes" in broken(hole)
    assert "longitude comes before latitude" in broken(swapped)
    assert "must be a Polygon" in broken(lambda d: feature(d, "lane")["properties"].update(kind="keep_in"))
    assert "WGS 84" in broken(lambda d: d.update(crs={"properties": {"name": "EPSG:25830"}}))
    assert "used twice" in broken(lambda d: d["features"].append(feature(d, "row")))
    assert "more than one warehouse" in broken(lambda d: d["features"].append(feature(d, "warehouse")))


def test_all_problems_are_listed_at_once() -> None:
    def change(document: dict[str, Any]) -> None:
        feature(document, "row")["properties"].update(width="wide", speed=-1.0)
        feature(document, "lane")["properties"]["kind"] = "street"

    text = broken(change)
    assert all(word in text for word in ('"width"', '"speed"', "street"))


def test_unknown_properties_are_named_not_refused() -> None:
    document = site_to_geojson(SITE)
    feature(document, "row")["properties"]["variety"] = "Pinot Noir"
    imported = import_site(document)
    assert any("variety" in note for note in imported.notes)
    assert_same(SITE, imported.site)


def test_without_our_datum_the_middle_of_the_positions_is_the_origin() -> None:
    document = site_to_geojson(SITE)
    del document["rowpilot"]
    site = import_site(document).site
    frames = EnuFrame(site.datum), EnuFrame(SITE.datum)
    assert site.rows[0].id == "R1"
    places = [f.to_geodetic(*row.start, 0.0) for f, row in zip(frames, (site.rows[0], SITE.rows[0]), strict=True)]
    assert places[0][:2] == pytest.approx(places[1][:2], abs=1e-8)


json_values = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=5),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=5), inner, max_size=4),
    max_leaves=12,
)
features = st.fixed_dictionaries(
    {
        "type": st.just("Feature"),
        "properties": st.dictionaries(st.sampled_from(["kind", "id", "name", "width", "speed"]), json_values)
        | st.fixed_dictionaries({"kind": st.sampled_from(["row", "lane", "plant", "keep_in", "warehouse"])}),
        "geometry": st.fixed_dictionaries(
            {
                "type": st.sampled_from(["Point", "LineString", "Polygon", "MultiPoint"]),
                "coordinates": json_values | st.lists(st.floats(-90, 90), min_size=2, max_size=3)
                | st.lists(st.lists(st.floats(-90, 90), min_size=2, max_size=2), min_size=2, max_size=5),
            }
        ),
    }
)  # fmt: skip


@settings(max_examples=150)
@given(json_values | st.fixed_dictionaries({"type": st.just("FeatureCollection"), "features": st.lists(features)}))
def test_no_document_crashes_the_importers(document: object) -> None:
    with suppress(SiteError):
        assert import_site(document).site.name
    with suppress(MissionError):
        assert mission_from_geojson(document, SITE).name


def test_a_mission_with_unknown_row_broken_numbers_and_doubled_order_lists_all() -> None:
    document = mission_to_geojson(MISSION, SITE)
    document["features"][0]["properties"]["speed"] = math.nan
    document["features"][1]["properties"]["number"] = 1
    document["features"][2]["properties"].update(row_id="R9", exit="fly")
    with pytest.raises(MissionError) as caught:
        mission_from_geojson(document, SITE)
    text = str(caught.value)
    assert all(word in text for word in ('"speed"', "R9", '"exit"', "same number"))


def test_files_of_other_programs_are_refused_with_a_sentence(shared_data: Path) -> None:
    paths = [p for p in (shared_data / "plans").rglob("*") if p.suffix in (".json", ".geojson", ".plan")]
    assert paths
    for path in paths:
        with pytest.raises(SiteError, match="cannot be imported"):
            import_site(json.loads(path.read_text()))
