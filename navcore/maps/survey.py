"""Surveyed posts and vines, grouped into lines by names such as ROW03POLE02.

Names are typed by people in the field, so each is checked against where the point stands; what disagrees is corrected
by geometry and said.
"""

from __future__ import annotations

import csv
import io
import re
from collections import Counter
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import SiteError
from navcore.geometry.geodesy import EnuFrame
from navcore.maps.geojson_features import Problems, ReadFeature
from navcore.maps.plant_lines import PlantLine, alleys, along, robust_line
from navcore.maps.site_map import Plant, PlantKind, Row

Floats = NDArray[np.float64]
_NAME = re.compile(r"^(ROW\s*\d+)\s*[-_ ]?\s*(POLE|POST|VINE|TRUNK)\s*(\d+)$", re.IGNORECASE)
_KINDS = {"POLE": PlantKind.POST, "POST": PlantKind.POST, "VINE": PlantKind.TRUNK, "TRUNK": PlantKind.TRUNK}
# A point further than this from its line stands in another one or nowhere, m.
_OFF_LINE = 0.6


@dataclass(frozen=True, slots=True)
class SurveyedPoint:
    """A point with the name it was given."""

    name: str
    line: str
    kind: PlantKind
    number: int
    x: float
    y: float


def is_survey(features: list[ReadFeature]) -> bool:
    """True if most features are points with a row's name."""
    return sum(_row_name(feature) is not None for feature in features) > len(features) / 2


def _row_name(feature: ReadFeature) -> re.Match[str] | None:
    if feature.geometry != "Point":
        return None
    texts = (value.strip() for value in feature.properties.values() if isinstance(value, str))
    return next((match for text in texts if (match := _NAME.match(text))), None)


def surveyed_rows(
    features: list[ReadFeature], frame: EnuFrame, problems: Problems
) -> tuple[tuple[Row, ...], tuple[Plant, ...]]:
    """Rows between neighbouring lines of posts, and all points as plants. Corrections are noted."""
    points = _named_points(features, frame, problems)
    lines, points = _lines(points, problems)
    rows = alleys(lines, None)
    if not rows and not problems.found:
        problems.add("The survey holds fewer than two lines of posts side by side, so there is no row to drive.")
    problems.notes.append(f"{len(lines)} lines of plants: the {len(rows)} alleys between them are the rows to drive.")
    return rows, tuple(Plant(x=p.x, y=p.y, kind=p.kind) for p in points)


def _named_points(features: list[ReadFeature], frame: EnuFrame, problems: Problems) -> list[SurveyedPoint]:
    points = []
    for feature in features:
        match = _row_name(feature)
        if match is None:
            problems.add(f"{feature.title} is no point with a name such as ROW03POLE02. Remove or name it.")
            continue
        lon, lat = feature.positions[0]
        points.append(_point(match, *frame.to_enu(lat, lon, frame.height_m)[:2]))
    return points


def _point(match: re.Match[str], x: float, y: float) -> SurveyedPoint:
    line, word, number = match.groups()
    name = line.upper().replace(" ", "")
    return SurveyedPoint(match.string.strip(), name, _KINDS[word.upper()], int(number), round(x, 6), round(y, 6))


def _lines(points: list[SurveyedPoint], problems: Problems) -> tuple[list[PlantLine], list[SurveyedPoint]]:
    """One line for each name with at least two points; points are moved to the line they stand in."""
    named: dict[str, list[SurveyedPoint]] = {}
    for point in points:
        named.setdefault(point.line, []).append(point)
    fits = {name: robust_line(_xy(group)) for name, group in named.items() if len(group) > 1}
    if not fits:
        return [], points
    placed: dict[str, list[SurveyedPoint]] = {name: [] for name in fits}
    for point in points:
        nearest = min(fits, key=lambda name: abs(fits[name].distance(point.x, point.y)))
        own = abs(fits[point.line].distance(point.x, point.y)) if point.line in fits else np.inf
        stands_in = point.line if own <= _OFF_LINE else nearest
        _note_wrong_line(point, stands_in, abs(fits[stands_in].distance(point.x, point.y)), problems)
        placed[stands_in].append(point)
    for name, group in placed.items():
        _note_wrong_numbers(name, group, along(fits[name], _xy(group)), problems)
    lines = [_plant_line(name, group) for name, group in placed.items() if len(group) > 1]
    return lines, points


def _note_wrong_line(point: SurveyedPoint, stands_in: str, off: float, problems: Problems) -> None:
    if off > _OFF_LINE:
        problems.add(
            f"{point.name} at ({point.x:.2f}, {point.y:.2f}) m stands {off:.1f} m from every line. "
            "Correct or remove it."
        )
    elif stands_in != point.line:
        problems.notes.append(
            f"{point.name} at ({point.x:.2f}, {point.y:.2f}) m stands in {stands_in}, not in {point.line}: "
            f"taken as part of {stands_in}. Correct its name."
        )


def _note_wrong_numbers(name: str, group: list[SurveyedPoint], places: Floats, problems: Problems) -> None:
    """Say where the numbers given do not run along the line, judged by the direction in which most do."""
    for kind in sorted({p.kind for p in group}):
        members = [i for i, p in enumerate(group) if p.kind is kind]
        numbers = np.array([group[i].number for i in members], dtype=np.float64)
        order = np.argsort(places[members])
        if len(members) > 1 and np.dot(numbers - numbers.mean(), places[members] - places[members].mean()) < 0.0:
            order = order[::-1]
        _note_order(name, [group[members[int(i)]] for i in order], problems)


def _note_order(name: str, ordered: list[SurveyedPoint], problems: Problems) -> None:
    """Numbers must grow along the line; gaps in them are no fault."""
    counts, last = Counter(p.name for p in ordered), 0
    for point in (p for p in ordered if p.line == name):
        if point.number > last:
            last = point.number
            continue
        last += 1
        twice = " and its name is used twice" if counts[point.name] > 1 else ""
        problems.notes.append(
            f"{point.name} at ({point.x:.2f}, {point.y:.2f}) m stands after number {last - 1} of {name}{twice}: "
            f"taken as number {last}. Correct its name."
        )


def _plant_line(name: str, group: list[SurveyedPoint]) -> PlantLine:
    """Ordered along the line, from the end with the low numbers."""
    points = _xy(group)
    line = robust_line(points)
    order = np.argsort(along(line, points))
    numbers = np.array([p.number for p in group], dtype=np.float64)[order]
    if np.dot(numbers - numbers.mean(), np.arange(len(numbers)) - (len(numbers) - 1) / 2) < 0.0:
        return PlantLine(name, line.reversed(), points[order[::-1]])
    return PlantLine(name, line, points[order])


def _xy(group: list[SurveyedPoint]) -> Floats:
    return np.array([(p.x, p.y) for p in group], dtype=np.float64)


def vines_from_csv(text: str, frame: EnuFrame) -> tuple[Plant, ...]:
    """Trunks from a table with columns "Vine ID" (or "id"), "Latitude" and "Longitude" in degrees.

    Raises SiteError that names every row without sound numbers.
    """
    reader = csv.DictReader(io.StringIO(text.lstrip("﻿")))
    if not {"Latitude", "Longitude"} <= set(reader.fieldnames or ()):
        raise SiteError('The table of vines needs the columns "Latitude" and "Longitude".')
    plants, bad = [], []
    for number, row in enumerate(reader, start=2):
        position = _degrees(row.get("Latitude")), _degrees(row.get("Longitude"))
        if position[0] is None or position[1] is None or abs(position[0]) > 90.0 or abs(position[1]) > 180.0:
            bad.append(f"Line {number} of the table of vines has no sound latitude and longitude.")
            continue
        x, y, _ = frame.to_enu(position[0], position[1], frame.height_m)
        plants.append(Plant(x=round(x, 6), y=round(y, 6), kind=PlantKind.TRUNK))
    if bad:
        raise SiteError(" ".join(bad[:20]), bad)
    return tuple(plants)


def _degrees(text: str | None) -> float | None:
    try:
        value = float(text or "")
    except ValueError:
        return None
    return value if np.isfinite(value) else None
