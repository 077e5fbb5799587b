"""How a page starts a mission."""

from __future__ import annotations

import json
from typing import Any

import msgspec
from fastapi.testclient import TestClient


def as_json(value: object) -> Any:
    """As the station sends it."""
    return json.loads(msgspec.json.encode(value))


def start(client: TestClient, mission: dict[str, Any]) -> Any:
    """By a new start button."""
    nonce = client.get("/api/drive/nonce").json()["nonce"]
    return client.post("/api/runs", json={"mission_id": mission["id"], "link_loss": "stop", "nonce": nonce})
