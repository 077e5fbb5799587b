"""One browser's live feed."""

from __future__ import annotations

from starlette.websockets import WebSocket


async def serve(websocket: WebSocket, hub: object, logins: object) -> None:
    """Until the browser leaves."""
