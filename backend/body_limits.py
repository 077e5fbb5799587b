"""How much a request may carry, by route."""

from __future__ import annotations

from starlette.datastructures import Headers
from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from backend.errors import body

SMALL = 64 * 2**10
DOCUMENT = 4 * 2**20  # a farm of 2000 rows and 20,000 plants is 2 MB
UPLOADS = ("/api/orthophotos", "/orthophoto", "/found-rows")  # limited by `backend.uploads` while they stream to disk
LANELETS = 64 * 2**20  # the same farm as Lanelet2 OSM is 20 MB
DOCUMENTS = ("/api/sites", "/api/missions")


def limit_of(path: str) -> int | None:
    """Bytes that a body sent to `path` may have; None where the route limits it itself."""
    if path.endswith(UPLOADS):
        return None
    if path == "/api/sites/import/osm":
        return LANELETS
    return DOCUMENT if path.startswith(DOCUMENTS) else SMALL


class BodyLimit:
    """ASGI middleware: refuses by the announced length, and stops reading where none was announced."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass on, or answer 413."""
        limit = limit_of(scope["path"]) if scope["type"] == "http" else None
        if limit is None:
            await self._app(scope, receive, send)
        elif _announced(scope) > limit:
            await _too_large(limit)(scope, receive, send)
        else:
            await _Counted(limit).run(self._app, scope, receive, send)


class _Counted:
    """One request whose body is counted while it is read."""

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._seen = 0
        self._answered = False

    async def run(self, app: ASGIApp, scope: Scope, receive: Receive, send: Send) -> None:
        async def counted() -> Message:
            message = await receive()
            self._seen += len(message.get("body", b""))
            return {"type": "http.disconnect"} if self._exceeded else message

        async def replaced(message: Message) -> None:
            if not self._exceeded:
                await send(message)
            elif not self._answered:
                self._answered = True
                await _too_large(self._limit)(scope, receive, send)

        await app(scope, counted, replaced)

    @property
    def _exceeded(self) -> bool:
        return self._seen > self._limit


def _announced(scope: Scope) -> int:
    length = Headers(scope=scope).get("content-length", "0")
    return int(length) if length.isdecimal() and len(length) < 20 else 0


def _too_large(limit: int) -> JSONResponse:
    return JSONResponse(body(f"The request is larger than the {limit // 1024} kB that this address takes."), 413)
