"""What was drawn must fit on a farm: one stray number would keep the planner or the simulator busy for ever."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from navcore.errors import MissionError, SiteError
from navcore.maps.mission import Mission
from navcore.maps.site_map import Point, Row, SiteMap

FARTHEST = 20_000.0  # m from the site's datum, as `navcore.maps.geojson` takes them
LONGEST_TEXT = 200  # characters
WIDEST = 50.0  # m
SPACING = (0.1, 100.0)  # m
MOST = {"lanes": 500, "rows": 5_000, "zones": 500, "plants": 100_000}
MOST_STOPS = 2_000
MOST_REASONS = 20


class Shape(NamedTuple):
    """Something drawn. `least` different points make one of it."""

    label: str
    texts: tuple[str, ...]
    points: Sequence[Point]
    least: int = 1


def check_site(site: SiteMap) -> SiteMap:
    """The site, if all of it is on one farm. Raises SiteError with every reason."""
    reasons = [*_number_reasons(site)]
    if not reasons:
        reasons += [*_datum_reasons(site), *_row_reasons(site.rows), *_shape_reasons(_shapes(site))]
    if reasons:
        raise SiteError("The site was not stored.", reasons[:MOST_REASONS])
    return site


def check_mission(mission: Mission) -> Mission:
    """The mission, if all of it is on one farm. Raises MissionError with every reason."""
    stops = len(mission.outbound) + len(mission.visits) + len(mission.inbound)
    if stops > MOST_STOPS:
        raise MissionError([f"The mission has {stops} waypoints and rows; it may have {MOST_STOPS}. Split it."])
    points = [(point.x, point.y) for point in (*mission.outbound, *mission.inbound)]
    texts = (mission.name, *(visit.row_id for visit in mission.visits))
    reasons = [*_shape_reasons([Shape("The mission", texts, points, 0)])]
    if reasons:
        raise MissionError(reasons)
    return mission


def _number_reasons(site: SiteMap) -> Iterator[str]:
    for name, most in MOST.items():
        number = len(getattr(site, name))
        if number > most:
            yield f"The site has {number} {name}; it may have {most}. Make two sites of it."


def _datum_reasons(site: SiteMap) -> Iterator[str]:
    datum = site.datum
    if abs(datum.lat_deg) > 90.0 or abs(datum.lon_deg) > 180.0 or abs(datum.height_m) > FARTHEST:
        yield "The site's datum is not on the Earth. Give its latitude, longitude and height again."


def _row_reasons(rows: Sequence[Row]) -> Iterator[str]:
    low, high = SPACING
    for row in rows:
        if not row.width <= WIDEST:
            yield f"Row {_short(row.name or row.id)} is {row.width:g} m wide; {WIDEST:g} m are possible."
        if not (low <= row.post_spacing <= high and low <= row.plant_spacing <= high):
            yield f"The spacings in row {_short(row.name or row.id)} must be from {low:g} to {high:g} m."


def _shapes(site: SiteMap) -> Iterator[Shape]:
    yield Shape("The site", (site.name, site.datum.frame, site.datum.corrections), ())
    if site.warehouse is not None:
        yield Shape("The warehouse", (site.warehouse.name,), [(site.warehouse.x, site.warehouse.y)])
    for lane in site.lanes:
        yield Shape(f"Lane {_short(lane.name or lane.id)}", (lane.id, lane.name), lane.points, 2)
    for row in site.rows:
        yield Shape(f"Row {_short(row.name or row.id)}", (row.id, row.name), (row.start, row.end))
    for zone in site.zones:
        yield Shape(f"Zone {_short(zone.name or zone.id)}", (zone.id, zone.name), zone.polygon, 3)
    yield Shape("A plant", (), [(plant.x, plant.y) for plant in site.plants])


def _shape_reasons(shapes: Iterator[Shape] | list[Shape]) -> Iterator[str]:
    for shape in shapes:
        if any(len(text) > LONGEST_TEXT for text in shape.texts):
            yield f"{shape.label} has a name of more than {LONGEST_TEXT} characters. Shorten it."
        if not all(abs(value) <= FARTHEST for point in shape.points for value in point):
            yield f"{shape.label} lies more than {FARTHEST / 1000:g} km from the site's middle. Move it or remove it."
        if shape.least > 1 and len(set(shape.points)) < shape.least:
            yield f"{shape.label} needs at least {shape.least} different points. Draw it again."


def _short(name: str) -> str:
    return name[:40]
