"""How a page sends things, good and bad, and starts a mission."""

from __future__ import annotations

import json
from typing import Any

import msgspec
from fastapi.testclient import TestClient


def as_json(value: object) -> Any:
    """As the station sends it."""
    return json.loads(msgspec.json.encode(value))


def paths_to_numbers(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Where numbers with a fraction stand in a JSON document."""
    if isinstance(value, dict):
        return [found for key, item in value.items() for found in paths_to_numbers(item, (*path, key))]
    if isinstance(value, list):
        return [found for i, item in enumerate(value) for found in paths_to_numbers(item, (*path, i))]
    return [path] if isinstance(value, float) else []


def with_text_at(document: Any, path: tuple[Any, ...], text: str) -> str:
    """The document's JSON with that text, which need be no JSON, at one place."""
    copy = json.loads(json.dumps(document))
    place = copy
    for key in path[:-1]:
        place = place[key]
    place[path[-1]] = "HERE"
    return json.dumps(copy).replace('"HERE"', text)


def start(client: TestClient, mission: dict[str, Any]) -> Any:
    """By a new start button."""
    nonce = client.get("/api/drive/nonce").json()["nonce"]
    return client.post("/api/runs", json={"mission_id": mission["id"], "link_loss": "stop", "nonce": nonce})
