"""Passes the 3D view's HTTP and WebSocket on to the viser process on loopback."""

from __future__ import annotations

from starlette.requests import Request
from starlette.responses import Response
from starlette.websockets import WebSocket


async def fetch(request: Request, port: int | None, path: str) -> Response:
    """A file."""
    return Response(status_code=404)


async def bridge(websocket: WebSocket, port: int | None, logins: object) -> None:
    """Until one side leaves."""
