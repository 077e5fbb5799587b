"""Serves the station: `python -m backend`. Prints the one-time address; writes no token into any log."""

from __future__ import annotations

import logging
import socket
import sys
from urllib.parse import urlsplit

import uvicorn

from backend.connections import Connection
from backend.main import create_app
from backend.settings import Settings
from backend.station import Station

LONGEST_SOCKET_MESSAGE = 64 * 2**10
KEEP_ALIVE_S = 75
LOG_FORMAT = "%(asctime)s %(name)s %(levelname)s %(message)s"


class WithoutQuery(logging.Filter):
    """Cuts the query off the paths of the access log: that of `/enter` is a secret."""

    def filter(self, record: logging.LogRecord) -> bool:
        """Uvicorn's arguments are client, method, path with query, HTTP version, status."""
        if isinstance(record.args, tuple) and len(record.args) == 5:
            client, method, path, *rest = record.args
            record.args = (client, method, urlsplit(str(path)).path, *rest)
        return True


def serve(settings: Settings) -> None:
    """Run until SIGTERM or SIGINT."""
    logging.basicConfig(level=logging.INFO, format=LOG_FORMAT, stream=sys.stderr)
    for quiet in ("alembic", "websockets", "rasterio"):
        logging.getLogger(quiet).setLevel(logging.WARNING)
    logging.getLogger("uvicorn.access").addFilter(WithoutQuery())
    listener = listen(settings)
    bound = settings.model_copy(update={"port": listener.getsockname()[1], "scene_port": scene_port(settings)})
    app = create_app(bound)
    station: Station = app.state.station
    sys.stdout.write(f"\n  Rowpilot is ready. Open this address (it works once):\n\n    {address(station)}\n\n")
    sys.stdout.flush()
    uvicorn.Server(config(app)).run([listener])


def listen(settings: Settings) -> socket.socket:
    """The station's one socket; it listens before anything is printed, so that an early browser waits.

    Ends the process with a sentence where that address cannot be had.
    """
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listener.bind((settings.host, settings.port))
    except OSError as error:
        listener.close()
        raise SystemExit(
            f"The station cannot listen on {settings.host}, port {settings.port}: {error.strerror}. "
            "Stop what uses it, or choose another port with --port."
        ) from error
    listener.listen()
    return listener


def scene_port(settings: Settings) -> int | None:
    """The port of the settings, or one that is free now."""
    if not settings.scene or settings.scene_port is not None:
        return settings.scene_port if settings.scene else None
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
    return port


def address(station: Station) -> str:
    """Where a browser enters, once."""
    host = station.settings.host
    shown = {"0.0.0.0": socket.gethostname(), "::": socket.gethostname()}.get(
        host, f"[{host}]" if ":" in host else host
    )
    return f"http://{shown}:{station.settings.port}/enter?token={station.logins.invite(None)}"


def config(app: object) -> uvicorn.Config:
    """Camera pictures are JPEG already, so nothing is compressed again; a dead browser is noticed in 10 s.

    A connection is kept for longer than any page pauses between two questions: one that is closed just when the next
    question comes is reset.
    """
    return uvicorn.Config(
        app,  # type: ignore[arg-type]
        log_config=None,
        proxy_headers=False,
        server_header=False,
        date_header=False,
        http=Connection,
        ws="websockets-sansio",
        ws_max_size=LONGEST_SOCKET_MESSAGE,
        ws_per_message_deflate=False,
        ws_ping_interval=5.0,
        ws_ping_timeout=5.0,
        timeout_keep_alive=KEEP_ALIVE_S,
        timeout_graceful_shutdown=3,
    )
