"""The 3D view: viser on loopback, shown under our own address behind our own login."""

from __future__ import annotations

from urllib.parse import quote

from fastapi import APIRouter, Request, Response, WebSocket

from backend import scene_proxy
from backend.deps import TheLogin, TheStation

router = APIRouter(tags=["scene"], include_in_schema=False)


@router.get("/scene/{path:path}")
async def scene_files(station: TheStation, login: TheLogin, request: Request, path: str) -> Response:
    """The viewer's page and files, from the loopback server."""
    if not path:
        return await scene_proxy.fetch_page(station.settings.scene_port)
    encodings = request.headers.get("accept-encoding", "identity")
    return await scene_proxy.fetch(station.settings.scene_port, quote(path), encodings)


@router.websocket("/scene")
async def scene_socket(websocket: WebSocket, station: TheStation) -> None:
    """The viewer's socket; its client leaves the slash out."""
    await scene_proxy.bridge(websocket, station.settings.scene_port, station.logins)
