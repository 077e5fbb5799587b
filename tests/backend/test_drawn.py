"""What is drawn beyond all measure is refused in a sentence, and nothing of it stays."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from fastapi.testclient import TestClient

from navcore.maps.mission import Mission, RowVisit, Waypoint
from navcore.maps.site_map import Datum, Lane, SiteMap, Warehouse, Zone, ZoneKind
from tests.backend.starting import as_json

Change = Callable[[SiteMap], SiteMap]


def with_row(**changes: Any) -> Change:
    return lambda site: replace(site, rows=(replace(site.rows[0], **changes), *site.rows[1:]))


def with_zone(*polygon: tuple[float, float]) -> Change:
    return lambda site: replace(site, zones=(Zone(id="pond", kind=ZoneKind.KEEP_OUT, polygon=polygon),))


BEYOND: dict[str, tuple[Change, str]] = {
    "a row as long as the universe": (with_row(end=(1e308, -1e308)), "Row r1 lies more than 20 km"),
    "a row over the horizon": (with_row(start=(0.0, 20_001.0)), "Row r1 lies more than 20 km"),
    "a row as wide as a field": (with_row(width=51.0), "51 m wide"),
    "posts without end": (with_row(post_spacing=1e-300), "spacings in row r1"),
    "no room between plants": (with_row(plant_spacing=0.0), "spacings in row r1"),
    "a far warehouse": (lambda s: replace(s, warehouse=Warehouse(x=-1e9, y=0.0, yaw=0.0)), "warehouse lies more"),
    "a lane of one point": (
        lambda s: replace(s, lanes=(Lane(id="l", points=((1.0, 1.0),)),)),
        "at least 2 different",
    ),
    "a lane that stays": (lambda s: replace(s, lanes=(Lane(id="l", points=((1.0, 1.0),) * 3),)), "at least 2 diff"),
    "a zone without corners": (with_zone(), "Zone pond needs at least 3"),
    "a zone of two corners": (with_zone((0.0, 0.0), (1.0, 0.0), (0.0, 0.0)), "Zone pond needs at least 3"),
    "a place beside the Earth": (
        lambda s: replace(s, datum=Datum(lat_deg=91.0, lon_deg=0.0, height_m=0.0)),
        "not on the Earth",
    ),
    "a name without end": (lambda s: replace(s, name="x" * 201), "more than 200 characters"),
    "too many lanes": (lambda s: replace(s, lanes=s.lanes * 501), "501 lanes"),
}


@pytest.mark.parametrize("kind", BEYOND)
def test_a_site_beyond_all_measure_is_refused_and_the_stored_one_stays(
    client: TestClient, site: SiteMap, kind: str
) -> None:
    change, sentence = BEYOND[kind]
    stored = client.post("/api/sites", json={"site": as_json(site)}).json()
    for answer in (
        client.post("/api/sites", json={"site": as_json(change(site))}),
        client.put(f"/api/sites/{stored['id']}", json={"version": 1, "site": as_json(change(site))}),
    ):
        assert answer.status_code == 422
        assert any(sentence in reason for reason in answer.json()["reasons"]), answer.json()
    assert client.get(f"/api/sites/{stored['id']}").json() == stored
    assert len(client.get("/api/sites").json()) == 1


def test_every_reason_is_told_at_once(client: TestClient, site: SiteMap) -> None:
    bad = replace(with_row(width=90.0)(with_zone()(site)), name="x" * 300)
    assert len(client.post("/api/sites", json={"site": as_json(bad)}).json()["reasons"]) == 3


MISSIONS: dict[str, tuple[Callable[[Mission], Mission], str]] = {
    "far": (lambda m: replace(m, outbound=(Waypoint(x=1e308, y=0.0),)), "20 km"),
    "endless": (lambda m: replace(m, outbound=(Waypoint(x=0.0, y=0.0),) * 2_000), "2002 waypoints"),
    "nameless": (lambda m: replace(m, name="x" * 201), "200 characters"),
    "of no row": (lambda m: replace(m, visits=(RowVisit(row_id="r" * 201),)), "200 characters"),
}


@pytest.mark.parametrize("kind", MISSIONS)
def test_a_mission_beyond_all_measure_is_neither_drawn_nor_stored(
    client: TestClient, site: SiteMap, mission: Mission, kind: str
) -> None:
    change, sentence = MISSIONS[kind]
    farm = f"/api/sites/{client.post('/api/sites', json={'site': as_json(site)}).json()['id']}"
    stored = client.post(f"{farm}/missions", json={"mission": as_json(mission)}).json()
    body = {"mission": as_json(change(mission))}
    for answer in (
        client.post(f"{farm}/missions", json=body),
        client.post(f"{farm}/preview", json=body),
        client.put(f"/api/missions/{stored['id']}", json=body | {"version": 1}),
    ):
        assert answer.status_code == 422
        assert any(sentence in reason for reason in answer.json()["reasons"]), answer.json()
    assert client.get(f"{farm}/missions").json() == [stored]
