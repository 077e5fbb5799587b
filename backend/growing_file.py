"""Sends a file that may still be written to."""

from __future__ import annotations

from starlette.datastructures import Headers
from starlette.responses import FileResponse
from starlette.types import Message, Receive, Scope, Send


class GrowingFileResponse(FileResponse):
    """The file as long as it was when the answer began; what is appended meanwhile is left out.

    Plain `FileResponse` announces the length first and then reads to the end, so a log that grows breaks the answer.
    """

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send no more than was announced."""
        await super().__call__(scope, receive, AnnouncedLength(send))


class AnnouncedLength:
    """An ASGI `send` of one answer that leaves out what exceeds its Content-Length."""

    def __init__(self, send: Send) -> None:
        self._send = send
        self._left = 0
        self._ended = False

    async def __call__(self, message: Message) -> None:
        """Pass `message` on, cut."""
        if message["type"] == "http.response.start":
            self._left = int(Headers(raw=message["headers"])["content-length"])
            await self._send(message)
        elif not self._ended:
            await self._send(self._cut(message))

    def _cut(self, message: Message) -> Message:
        body: bytes = message.get("body", b"")[: self._left]
        self._left -= len(body)
        self._ended = self._left == 0 or not message.get("more_body", False)
        return {**message, "body": body, "more_body": not self._ended}
