"""The gate before every route: known host, known page, known login. What is not declared is denied."""

from __future__ import annotations

from collections.abc import Sequence
from http.cookies import CookieError, SimpleCookie
from ipaddress import ip_address
from urllib.parse import urlsplit

from starlette.datastructures import Headers
from starlette.responses import HTMLResponse, JSONResponse, Response
from starlette.routing import BaseRoute, Match
from starlette.types import ASGIApp, Receive, Scope, Send

from backend.errors import body
from backend.logins import Login, LoginBook
from backend.permissions import PERMISSIONS, Permission
from backend.settings import LOOPBACK_HOSTS, Settings

SAFE_METHODS = frozenset({"GET", "HEAD", "OPTIONS"})
UPLOADS = ("/api/orthophotos", "/orthophoto", "/found-rows", "/import/osm")
LOGIN_PAGE = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Rowpilot</title>
<body><h1>Please log in</h1><p>Open the address that the station printed in its terminal. It works once; after that
this browser stays logged in.</p><p><a href="/">Try again</a></p></body></html>"""
NO_LOGIN = "Please log in with the address that the station printed at its start."


class Gate:
    """ASGI middleware; puts the login into the scope as `rowpilot.login`."""

    def __init__(self, app: ASGIApp, settings: Settings, logins: LoginBook, routes: Sequence[BaseRoute]) -> None:
        self._app = app
        self._settings = settings
        self._logins = logins
        self._routes = routes

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let it through, or answer why not."""
        if scope["type"] not in ("http", "websocket"):
            await self._app(scope, receive, send)
            return
        login = self._logins.find(self._cookie(Headers(scope=scope)))
        refusal = self._refusal(scope, login)
        if refusal is not None:
            await refuse(refusal, scope, receive, send)
            return
        scope["rowpilot.login"] = login
        await self._app(scope, receive, send)

    def _cookie(self, headers: Headers) -> str | None:
        try:
            morsel = SimpleCookie(headers.get("cookie", "")).get(self._settings.cookie_name)
        except CookieError:
            return None
        return morsel.value if morsel else None

    def _refusal(self, scope: Scope, login: Login | None) -> Response | None:
        headers = Headers(scope=scope)
        if not host_allowed(headers.get("host", ""), self._settings):
            return _error(
                421, "This station is not called by that name. Use the address that it printed at its start."
            )
        if self._permission(scope) is not Permission.PUBLIC and login is None:
            return _login_first(scope)
        if scope["type"] == "websocket":
            return None if same_origin(headers) else _foreign_page()
        if scope["method"] not in SAFE_METHODS:
            return _state_change_refusal(scope, headers)
        return None

    def _permission(self, scope: Scope) -> Permission:
        """Of the route that will answer; what no route answers needs a login as well."""
        method = scope.get("method", "WEBSOCKET")
        for route in self._routes:
            if route.matches(scope)[0] is Match.FULL:
                key = f"{'GET' if method == 'HEAD' else method} {getattr(route, 'path', '')}"
                return PERMISSIONS.get(key, Permission.LOGIN)
        return Permission.LOGIN


def host_allowed(host: str, settings: Settings) -> bool:
    """Against DNS rebinding: our own names, and on an open network any address that is no name."""
    try:
        name = urlsplit(f"//{host}").hostname or ""
    except ValueError:
        return False
    if name in LOOPBACK_HOSTS or name in settings.allowed_hosts or (name == settings.host and name):
        return True
    return settings.open_to_network and _is_address(name)


def _is_address(name: str) -> bool:
    try:
        ip_address(name)
    except ValueError:
        return False
    return True


def same_origin(headers: Headers) -> bool:
    """Whether the page that asks came from this station. Browsers send Origin with all that could do harm."""
    origin, host = headers.get("origin", ""), headers.get("host", "")
    return bool(host) and origin in (f"http://{host}", f"https://{host}")


def _state_change_refusal(scope: Scope, headers: Headers) -> Response | None:
    if not same_origin(headers) or headers.get("x-rowpilot") != "1":
        return _foreign_page()
    kind = headers.get("content-type", "").partition(";")[0].strip().lower()
    has_body = headers.get("content-length", "0") != "0" or "transfer-encoding" in headers
    if has_body and kind != "application/json" and not scope["path"].endswith(UPLOADS):
        return _error(415, "Send JSON with the content type application/json.")
    return None


def _foreign_page() -> Response:
    return _error(403, "This request does not come from the station's own page.")


def _login_first(scope: Scope) -> Response:
    if scope["type"] == "http" and not scope["path"].startswith("/api/") and scope["method"] in SAFE_METHODS:
        return HTMLResponse(LOGIN_PAGE, 401)
    return _error(401, NO_LOGIN)


def _error(status: int, message: str) -> Response:
    return JSONResponse(body(message), status)


async def refuse(response: Response, scope: Scope, receive: Receive, send: Send) -> None:
    """A WebSocket is closed before it is accepted, which a browser sees as a refused handshake."""
    if scope["type"] == "websocket":
        await receive()
        await send({"type": "websocket.close", "code": 1008, "reason": ""})
        return
    await response(scope, receive, send)
