"""What must not be driven is kept as it was drawn, told in the preview, and never started."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from fastapi.testclient import TestClient

from navcore.maps.mission import Mission
from navcore.maps.site_map import Point, SiteMap, Zone, ZoneKind
from navcore.messages import RequestKind
from tests.backend.played_robot import PlayedRobot, until
from tests.backend.starting import as_json, paths_to_numbers, start, with_text_at

pytestmark = pytest.mark.usefixtures("robot")


def zone(kind: ZoneKind, *polygon: Point) -> Zone:
    return Zone(id="z", kind=kind, polygon=polygon, name="Pond")


CROSSED = ((-30.0, -30.0), (30.0, 80.0), (30.0, -30.0), (-30.0, 80.0))
ON_THE_WAY = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))  # around the waypoint: there is no way past it
AROUND_HOME = ((-25.0, -5.0), (-15.0, -5.0), (-15.0, 5.0), (-25.0, 5.0))
BAD: dict[str, tuple[Zone, str]] = {
    "a keep-out zone that crosses itself": (zone(ZoneKind.KEEP_OUT, *CROSSED), "zone Pond crosses itself. Move its"),
    "a keep-in zone that crosses itself": (zone(ZoneKind.KEEP_IN, *CROSSED), "zone Pond crosses itself. Move its"),
    "a way through a keep-out zone": (zone(ZoneKind.KEEP_OUT, *ON_THE_WAY), "keep-out zone"),
    "a way out of the keep-in zone": (zone(ZoneKind.KEEP_IN, *AROUND_HOME), "edge of the keep-in zone"),
}


@pytest.mark.parametrize("kind", BAD)
def test_a_mission_that_must_not_be_driven_is_kept_told_and_not_started(
    client: TestClient, robot: PlayedRobot, site: SiteMap, mission: Mission, kind: str
) -> None:
    bad, sentence = BAD[kind]
    drawn = replace(site, zones=(bad,))
    farm = client.post("/api/sites", json={"site": as_json(drawn)}).json()
    address = f"/api/sites/{farm['id']}"
    stored = client.post(f"{address}/missions", json={"mission": as_json(mission)}).json()
    assert client.post("/api/robot/site", json={"site_id": farm["id"]}).status_code == 200
    assert until(lambda: client.get("/api/robot").json()["connected"])
    preview = client.post(f"{address}/preview", json={"mission": stored["mission"]}).json()
    started = start(client, stored)
    assert started.status_code == 409
    for told in (preview["problems"], started.json()["reasons"]):
        assert any(sentence in reason for reason in told), told
    assert RequestKind.START not in robot.kinds()
    assert client.get(address).json()["site"] == as_json(drawn)
    assert client.get(f"{address}/missions").json() == [stored]
    assert client.get("/api/runs").json() == []


@pytest.mark.parametrize("wrong", ["NaN", "Infinity", "-Infinity", "1e999", '"nan"'])
def test_no_number_of_a_mission_may_be_anything_but_finite(
    client: TestClient, ready: dict[str, Any], wrong: str
) -> None:
    document = {"version": 1, "mission": ready["mission"]}
    places = paths_to_numbers(document)
    assert len(places) > 10
    for place in places:
        answer = client.put(
            f"/api/missions/{ready['id']}",
            content=with_text_at(document, place, wrong),
            headers={"Content-Type": "application/json"},
        )
        assert answer.status_code == 422, (place, answer.text)
    assert client.get(f"/api/missions/{ready['id']}").json() == ready
