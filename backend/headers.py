"""Headers that keep a browser from doing what we did not mean."""

from __future__ import annotations

from starlette.datastructures import MutableHeaders
from starlette.types import ASGIApp, Message, Receive, Scope, Send

PAGE_POLICY = (
    "default-src 'none'; script-src 'self'; style-src 'self'{nonce}; img-src 'self' data: blob:; "
    "font-src 'self' data:; connect-src 'self'; worker-src 'self' blob:; manifest-src 'self'; frame-src 'self'; "
    "frame-ancestors 'none'; object-src 'none'; base-uri 'none'; form-action 'self'"
)
SCENE_POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
    "connect-src 'self' data:; frame-ancestors 'self'; object-src 'none'; base-uri 'none'"
)
ALWAYS = {
    "X-Content-Type-Options": "nosniff",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), microphone=(), geolocation=(), usb=(), payment=()",
}


def page_policy(style_nonce: str | None = None) -> str:
    """Content security policy of our own pages; `style_nonce` allows the style elements that carry it."""
    return PAGE_POLICY.format(nonce=f" 'nonce-{style_nonce}'" if style_nonce else "")


class SecurityHeaders:
    """ASGI middleware. The 3D view's own path has its own policy; a page that set one keeps it."""

    def __init__(self, app: ASGIApp) -> None:
        self._app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Add the headers to every answer."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        path: str = scope["path"]

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                add(MutableHeaders(scope=message), path)
            await send(message)

        await self._app(scope, receive, send_with_headers)


def add(headers: MutableHeaders, path: str) -> None:
    """To one answer of `path`."""
    scene = path.startswith("/scene/")
    for name, value in ALWAYS.items():
        headers[name] = value
    if scene:
        headers["Content-Security-Policy"] = SCENE_POLICY
    else:
        headers.setdefault("Content-Security-Policy", page_policy())
    headers["X-Frame-Options"] = "SAMEORIGIN" if scene else "DENY"
    headers.setdefault("Cache-Control", "no-store")
