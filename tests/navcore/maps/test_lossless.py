"""Whatever farm and mission are drawn: out as GeoJSON and in again, nothing is lost."""

from __future__ import annotations

import json
import math
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.maps.geojson import import_site, mission_from_geojson, mission_to_geojson, site_to_geojson
from navcore.maps.mission import Mission, RowExit, RowVisit, Waypoint
from navcore.maps.site_map import Datum, Lane, Plant, PlantKind, Row, SiteMap, Warehouse, Zone, ZoneKind

AWAY = 12_000.0  # m from the datum
PLACE = 1e-4  # m
coordinates = st.floats(-AWAY, AWAY).map(lambda value: round(value, 4))
points = st.tuples(coordinates, coordinates)
speeds = st.floats(0.05, 5.0)
texts = st.text(st.characters(exclude_categories=["Cs"]), max_size=40)
names = texts.map(lambda text: text or "n")
lines = st.lists(points, min_size=2, max_size=6, unique=True).map(tuple)


@st.composite
def squares(draw: st.DrawFn) -> tuple[tuple[float, float], ...]:
    """Counter-clockwise, as they come back."""
    x, y, side = draw(coordinates), draw(coordinates), draw(st.floats(1.0, 200.0))
    return (x, y), (x + side, y), (x + side, y + side), (x, y + side)


warehouses = st.builds(Warehouse, x=coordinates, y=coordinates, yaw=st.floats(-math.pi, math.pi), name=names)
lanes = st.builds(Lane, id=names, points=lines, width=st.floats(0.5, 50.0), speed=speeds, name=texts)
rows = st.tuples(points, points).filter(lambda ends: math.dist(*ends) > 0.1).flatmap(
    lambda ends: st.builds(
        Row, id=names, start=st.just(ends[0]), end=st.just(ends[1]), width=st.floats(0.5, 50.0), speed=speeds,
        name=texts, post_spacing=st.floats(0.2, 100.0), plant_spacing=st.floats(0.1, 100.0),
    )
)  # fmt: skip
zones = st.builds(Zone, id=names, kind=st.sampled_from(ZoneKind), polygon=squares(), name=texts)
plants = st.builds(Plant, x=coordinates, y=coordinates, kind=st.sampled_from(PlantKind))
datums = st.builds(
    Datum, lat_deg=st.floats(-85.0, 85.0), lon_deg=st.floats(-179.0, 179.0), height_m=st.floats(-400.0, 5000.0),
    frame=st.sampled_from(("WGS 84", "ETRS89")), corrections=texts,
)  # fmt: skip


def several(kind: st.SearchStrategy[Any]) -> st.SearchStrategy[Any]:
    return st.lists(kind, max_size=4, unique_by=lambda thing: thing.id).map(tuple)


sites = st.builds(
    SiteMap, name=names, datum=datums, warehouse=st.none() | warehouses, lanes=several(lanes), rows=several(rows),
    zones=several(zones), plants=st.lists(plants, max_size=4).map(tuple),
)  # fmt: skip


def through_text(document: object) -> Any:
    return json.loads(json.dumps(document, allow_nan=False))


def difference(a: Any, b: Any) -> float:
    """Largest of all numbers; infinite where anything else differs."""
    if isinstance(a, float) and isinstance(b, float):
        return abs(a - b)
    if isinstance(a, tuple) and isinstance(b, tuple) and len(a) == len(b):
        return max((difference(x, y) for x, y in zip(a, b, strict=True)), default=0.0)
    fields = getattr(a, "__dataclass_fields__", None)
    if fields and type(a) is type(b):
        return max(difference(getattr(a, name), getattr(b, name)) for name in fields)
    return 0.0 if a == b else math.inf


@settings(max_examples=60, deadline=None)
@given(sites)
def test_a_site_comes_back_whole_and_to_a_tenth_of_a_millimetre(site: SiteMap) -> None:
    if site == SiteMap(name=site.name, datum=site.datum):
        return  # a file without features is refused
    imported = import_site(through_text(site_to_geojson(site)))
    assert difference(site, imported.site) < PLACE
    assert imported.notes == ()


@st.composite
def missions(draw: st.DrawFn) -> tuple[Mission, SiteMap]:
    site = draw(sites.filter(lambda site: site.rows))
    waypoints = st.lists(st.builds(Waypoint, x=coordinates, y=coordinates, speed=speeds), max_size=4).map(tuple)
    visits = st.builds(
        RowVisit, row_id=st.sampled_from([row.id for row in site.rows]), from_start=st.booleans(),
        exit=st.sampled_from(RowExit), speed=speeds,
    )  # fmt: skip
    visited = st.lists(visits, max_size=4).map(tuple)
    return draw(st.builds(Mission, id=names, name=names, outbound=waypoints, visits=visited, inbound=waypoints)), site


@settings(max_examples=60, deadline=None)
@given(missions())
def test_a_mission_comes_back_whole_and_in_its_order(drawn: tuple[Mission, SiteMap]) -> None:
    mission, site = drawn
    back = mission_from_geojson(through_text(mission_to_geojson(mission, site)), site)
    assert difference(mission, back) < PLACE
