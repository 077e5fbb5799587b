"""Whatever is sent to any address, in form or out of it: never an error of the station's own, always one form."""

from __future__ import annotations

import json
from typing import Any

import pytest
from fastapi.testclient import TestClient
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from backend.schemas import ErrorDocument
from navcore.maps.mission import Mission
from navcore.maps.site_map import SiteMap
from tests.backend.openapi_cases import WRONG_NUMBERS, Operation, cases, operations, places, with_wrong
from tests.backend.starting import as_json

pytestmark = pytest.mark.usefixtures("robot")
JSON = {"Content-Type": "application/json"}
CASES_PER_OPERATION = 15
OPERATIONS = list(operations())


@pytest.fixture
def known(client: TestClient, site: SiteMap, mission: Mission) -> dict[str, str]:
    """Ids of a farm and a mission that are there."""
    farm = client.post("/api/sites", json={"site": as_json(site)}).json()["id"]
    made = client.post(f"/api/sites/{farm}/missions", json={"mission": as_json(mission)}).json()
    return {"site_id": farm, "mission_id": made["id"]}


def no_number(text: str) -> Any:
    raise AssertionError(f"{text} was sent, which no browser can read")


def test_the_document_names_every_address() -> None:
    assert len(OPERATIONS) >= 34


@pytest.mark.parametrize("operation", OPERATIONS, ids=lambda operation: f"{operation.method} {operation.path}")
@settings(max_examples=CASES_PER_OPERATION, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_no_request_makes_the_station_stumble(
    client: TestClient, known: dict[str, str], operation: Operation, data: st.DataObject
) -> None:
    case = data.draw(cases(operation, known))
    answer = client.request(
        operation.method,
        case.path,
        params=case.query,
        content=case.body,
        headers=JSON,
    )
    assert answer.status_code < 500, answer.text
    if answer.content and answer.headers["content-type"].startswith("application/json"):
        told = json.loads(answer.text, parse_constant=no_number)
        if answer.status_code >= 400:
            assert ErrorDocument.model_validate(told).message.endswith(".")


@settings(max_examples=40, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_what_was_stored_can_be_exported_and_planned_on(
    client: TestClient, site: SiteMap, data: st.DataObject
) -> None:
    drawn = as_json(site)
    wrongs: list[Any] = data.draw(st.lists(st.sampled_from([*WRONG_NUMBERS, [], None, -3.0]), min_size=1, max_size=2))
    for wrong in wrongs:
        drawn = with_wrong(drawn, data.draw(st.sampled_from(places(drawn)[1:])), wrong)
    answer = client.post(
        "/api/sites", content=json.dumps({"site": drawn}), headers={"Content-Type": "application/json"}
    )
    assert answer.status_code in (201, 422)
    if answer.status_code == 422:
        return
    farm = f"/api/sites/{answer.json()['id']}"
    visits = [{"row_id": row["id"]} for row in answer.json()["site"]["rows"]]
    mission = {"id": "", "name": "all", "outbound": [], "visits": visits, "inbound": []}
    answers = [
        client.get(farm),
        client.get(f"{farm}/geojson"),
        client.post(f"{farm}/preview", json={"mission": mission}),
        *(client.post(f"{farm}/missions/for-row", json=visit | {"exit": "next_row"}) for visit in visits),
        client.delete(farm),
    ]
    assert max(answer.status_code for answer in answers) < 500, [answer.text[:300] for answer in answers]
