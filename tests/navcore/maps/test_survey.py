"""Surveyed posts become drivable rows; names that disagree with the ground are noticed."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from navcore.errors import SiteError
from navcore.geometry.geodesy import EnuFrame
from navcore.maps.geojson import import_site
from navcore.maps.plant_lines import robust_line
from navcore.maps.site_map import Datum, PlantKind
from navcore.maps.survey import vines_from_csv

DATUM = Datum(lat_deg=53.2681, lon_deg=-0.5244, height_m=0.0)

LINES = "4 lines of plants: the 3 alleys between them are the rows to drive."


def survey(*, lines: int = 4, posts: int = 5, spacing: float = 2.5) -> dict[str, Any]:
    frame, features = EnuFrame(DATUM), []
    for line in range(lines):
        for post in range(posts):
            lat, lon, _ = frame.to_geodetic(line * spacing, -5.5 * post, 0.0)
            name = f"ROW{line + 1:02d}POLE{post + 1:02d}"
            geometry = {"type": "Point", "coordinates": [lon, lat]}
            features.append({"type": "Feature", "properties": {"Point": name}, "geometry": geometry})
    return {"type": "FeatureCollection", "features": features}


def rename(document: dict[str, Any], old: str, new: str) -> None:
    next(f for f in document["features"] if f["properties"]["Point"] == old)["properties"]["Point"] = new


def test_the_rows_are_the_alleys_between_the_lines() -> None:
    imported = import_site(survey(), datum=DATUM)
    assert imported.notes == (LINES,)
    assert [row.id for row in imported.site.rows] == ["ROW01-ROW02", "ROW02-ROW03", "ROW03-ROW04"]
    row = imported.site.rows[1]
    assert row.start == pytest.approx((3.75, 0.0), abs=1e-3)
    assert row.end == pytest.approx((3.75, -22.0), abs=1e-3)
    assert row.width == pytest.approx(2.5, abs=1e-3)
    assert row.post_spacing == pytest.approx(5.5, abs=0.01)
    assert len(imported.site.plants) == 20


def test_a_post_named_after_the_wrong_row_is_put_where_it_stands() -> None:
    document = survey()
    rename(document, "ROW02POLE03", "ROW04POLE09")
    imported = import_site(document, datum=DATUM)
    assert imported.notes[1:] == (LINES,)
    assert "ROW04POLE09" in imported.notes[0]
    assert "stands in ROW02, not in ROW04" in imported.notes[0]
    assert all(row.width == pytest.approx(2.5, abs=1e-3) for row in imported.site.rows)


def test_a_doubled_number_is_noticed_by_its_place_along_the_row() -> None:
    document = survey()
    rename(document, "ROW03POLE05", "ROW03POLE01")
    imported = import_site(document, datum=DATUM)
    assert imported.notes[1:] == (LINES,)
    assert "stands after number 4 of ROW03" in imported.notes[0]
    assert imported.site.rows[2].end == pytest.approx((6.25, -22.0), abs=1e-3)


def test_a_gap_in_the_numbers_is_no_fault() -> None:
    document = survey()
    document["features"] = [f for f in document["features"] if f["properties"]["Point"] != "ROW02POLE03"]
    assert import_site(document, datum=DATUM).notes == (LINES,)


def test_a_post_in_no_line_is_refused() -> None:
    document = survey()
    lat, lon, _ = EnuFrame(DATUM).to_geodetic(3.75, -10.0, 0.0)
    document["features"][7]["geometry"]["coordinates"] = [lon, lat]
    with pytest.raises(SiteError, match=r"ROW02POLE03 .* from every line"):
        import_site(document, datum=DATUM)


def test_a_gap_between_two_blocks_is_no_row() -> None:
    document = survey()
    frame = EnuFrame(DATUM)
    for feature in document["features"][10:]:
        lon, lat = feature["geometry"]["coordinates"]
        e, n, _ = frame.to_enu(lat, lon, 0.0)
        lat, lon, _ = frame.to_geodetic(e + 20.0, n, 0.0)
        feature["geometry"]["coordinates"] = [lon, lat]
    assert [row.id for row in import_site(document, datum=DATUM).site.rows] == ["ROW01-ROW02", "ROW03-ROW04"]


def test_one_line_makes_no_row() -> None:
    with pytest.raises(SiteError, match="fewer than two lines"):
        import_site(survey(lines=1), datum=DATUM)


def test_a_wrong_point_does_not_move_a_line() -> None:
    points = np.array([(0.0, 0.0), (1.0, 0.01), (2.0, -0.01), (3.0, 0.0), (4.0, 3.0)])
    line = robust_line(points)
    assert abs(line.distance(2.0, 0.0)) < 0.02
    assert abs(math.sin(line.heading)) < 0.01


def test_the_riseholme_posts_become_nine_rows_and_the_wrong_name_is_said(shared_data: Path) -> None:
    document = json.loads((shared_data / "riseholme" / "riseholme_rtk_gps_poles.geojson").read_text())
    imported = import_site(document)
    rows = imported.site.rows
    assert len(rows) == 9
    assert imported.notes[1].startswith("10 lines of plants: the 9 alleys")
    assert imported.notes[2:] == ("The site lies at 53.26810 N, 0.52443 W, the middle of its features.",)
    assert "ROW07POLE01" in imported.notes[0]
    assert "number 4" in imported.notes[0]
    for row in rows:
        assert row.width == pytest.approx(2.5, abs=0.05)
        assert math.dist(row.start, row.end) == pytest.approx(16.9, abs=0.15)
        heading = math.degrees(math.atan2(row.end[1] - row.start[1], row.end[0] - row.start[0]))
        assert heading == pytest.approx(-81.6, abs=0.3)
    assert sum(p.kind is PlantKind.POST for p in imported.site.plants) == 40


def test_the_riseholme_vines_stand_in_the_surveyed_lines(shared_data: Path) -> None:
    folder = shared_data / "riseholme"
    site = import_site(json.loads((folder / "riseholme_rtk_gps_poles.geojson").read_text())).site
    vines = vines_from_csv((folder / "riseholme_vineyard_lat_long_vines.csv").read_text(), EnuFrame(site.datum))
    assert len(vines) == 120
    posts = np.array([(p.x, p.y) for p in site.plants])
    for line in range(10):
        fitted = robust_line(posts[4 * line : 4 * line + 4])
        trunks = np.array([(p.x, p.y) for p in vines[12 * line : 12 * line + 12]])
        assert np.abs(fitted.distances(trunks)).max() < 0.3


def test_a_broken_table_of_vines_names_its_lines() -> None:
    with pytest.raises(SiteError, match="columns"):
        vines_from_csv("a,b\n1,2\n", EnuFrame(DATUM))
    with pytest.raises(SiteError, match="Line 3"):
        vines_from_csv("Latitude,Longitude\n53.2,-0.5\nnan,-0.5\n", EnuFrame(DATUM))
