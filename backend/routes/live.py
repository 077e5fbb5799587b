"""The live feed: one in, many out."""

from __future__ import annotations

from fastapi import APIRouter, Response, WebSocket

from backend.deps import ERRORS, TheStation
from backend.live_socket import serve
from backend.schemas import LiveTopics

router = APIRouter(prefix="/api/live", tags=["live"], responses=ERRORS)


@router.websocket("")
async def live(websocket: WebSocket, station: TheStation) -> None:
    """Newest message of each topic, as the bus carries it; the gate has checked cookie and Origin."""
    await serve(websocket, station.hub, station.logins)


@router.get("/latest", response_model=LiveTopics)
def latest(station: TheStation) -> Response:
    """Newest message of each topic; what `/api/live` sends is `{"topic": name, "data": one of these}`."""
    return Response(station.hub.latest_json(), media_type="application/json")
