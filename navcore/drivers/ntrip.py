"""Corrections from an NTRIP caster (revisions 1 and 2, RTCM 10410.1).

Revision 2 is plain HTTP, so the connection is Python's own `http.client`, which follows no redirects; pygnssutils
cuts and checks the RTCM 3 messages. Its own client is not used: it drops the first packet and loses the chunks' beat
when a packet ends between a chunk and its line end.
"""

from __future__ import annotations

import base64
import http.client
import ipaddress
import socket
import threading
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass

from pygnssutils import RTCM3_PROTOCOL, GNSSReader

from navcore.errors import ConfigError

RECONNECT_S = 5.0
SILENCE_S = 10.0
STREAM_TYPE = "gnss/data"


@dataclass(frozen=True, slots=True, kw_only=True)
class NtripParams:
    """Which caster, from the robot's configuration only.

    Attributes:
        host, port: of the caster; the host must not be this machine or its own link unless `allow_local`.
        mountpoint: the stream; never empty.
        user, password: of the account.
        https: speak TLS.
        allow_local: a caster on this machine, for a base station of one's own.
    """

    host: str
    port: int = 2101
    mountpoint: str
    user: str = ""
    password: str = ""
    https: bool = False
    allow_local: bool = False

    def __post_init__(self) -> None:
        printable = all(" " < c < "\x7f" for c in self.host + self.mountpoint)
        if not self.host or not self.mountpoint or not printable or not 0 < self.port < 65_536:
            raise ConfigError("NTRIP needs a host, a mountpoint and a port from 1 to 65535 in the configuration.")


class IcyResponse(http.client.HTTPResponse):
    """Revision 1 answers `ICY 200 OK`, which is HTTP/1.0 in all but its name."""

    def _read_status(self) -> tuple[str, int, str]:
        line = self.fp.readline(1024).decode("iso-8859-1")
        protocol, _, rest = line.strip().partition(" ")
        code, _, reason = rest.partition(" ")
        if protocol not in ("ICY", "HTTP/1.0", "HTTP/1.1") or not code.isdigit():
            raise http.client.BadStatusLine(line)
        return ("HTTP/1.0" if protocol == "ICY" else protocol), int(code), reason


class NtripClient:
    """Streams RTCM 3 messages to `deliver` until stopped; a lost connection is opened again.

    Args:
        deliver: called in the client's thread with each whole RTCM 3 message.
        gga: newest GGA sentence of the rover, sent at the connection for streams that follow the rover.
    """

    def __init__(
        self, params: NtripParams, deliver: Callable[[bytes], None], gga: Callable[[], str] | None = None
    ) -> None:
        self._params = params
        self._deliver = deliver
        self._gga = gga
        self._stopping = threading.Event()
        self._socket: socket.socket | None = None
        self._thread = threading.Thread(target=self._run, name="ntrip", daemon=True)
        self.problem = "not connected yet"
        self.received = 0

    def start(self) -> None:
        """Connect, in a thread of its own."""
        self._thread.start()

    def stop(self) -> None:
        """Disconnect."""
        self._stopping.set()
        open_socket = self._socket
        if open_socket is not None:
            with suppress(OSError):
                open_socket.shutdown(socket.SHUT_RDWR)
        self._thread.join()

    def _run(self) -> None:
        while not self._stopping.is_set():
            try:
                self._stream()
            except (OSError, http.client.HTTPException, ConfigError) as error:
                self.problem = str(error) or type(error).__name__
            self._stopping.wait(RECONNECT_S)

    def _stream(self) -> None:
        connection = self._connect()
        connection.connect()
        self._socket = connection.sock
        try:
            connection.request("GET", f"/{self._params.mountpoint}", headers=self._headers())
            response = connection.getresponse()
            self.problem = _refusal(response)
            if not self.problem:
                self._read(response)
        finally:
            self._socket = None
            connection.close()

    def _read(self, response: http.client.HTTPResponse) -> None:
        reader = GNSSReader(response, protfilter=RTCM3_PROTOCOL, quitonerror=0, parsing=False)
        while not self._stopping.is_set():
            raw, _ = reader.read()
            if raw is None:
                raise ConnectionResetError("the caster closed the stream")
            self.received += 1
            self._deliver(bytes(raw))

    def _connect(self) -> http.client.HTTPConnection:
        p = self._params
        address = checked_address(p.host, p.port, p.allow_local)
        kind = http.client.HTTPSConnection if p.https else http.client.HTTPConnection
        connection = kind(p.host if p.https else address, p.port, timeout=SILENCE_S)
        connection.response_class = IcyResponse
        return connection

    def _headers(self) -> dict[str, str]:
        p = self._params
        headers = {
            "Host": f"{p.host}:{p.port}", "Ntrip-Version": "Ntrip/2.0", "User-Agent": "NTRIP rowpilot",
        }  # fmt: skip
        if p.user:
            secret = base64.b64encode(f"{p.user}:{p.password}".encode()).decode("ascii")
            headers["Authorization"] = f"Basic {secret}"
        if self._gga is not None:
            headers["Ntrip-GGA"] = self._gga().strip()
        return headers


def checked_address(host: str, port: int, allow_local: bool) -> str:
    """Numeric address of the host.

    Raises:
        ConfigError: if any of its addresses is loopback, link-local or unspecified and that is not allowed.
        OSError: if it has no address.
    """
    found = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)
    addresses = [str(address[0]).partition("%")[0] for *_, address in found]
    for address in addresses:
        ip = ipaddress.ip_address(address)
        if not allow_local and (ip.is_loopback or ip.is_link_local or ip.is_unspecified):
            raise ConfigError(
                f"The NTRIP host {host} is this machine or its own link ({ip}); name the caster's address."
            )
    return addresses[0]


def _refusal(response: http.client.HTTPResponse) -> str:
    if response.status != http.client.OK:
        return f"the caster refused: {response.status} {response.reason}"
    kind = response.getheader("Content-Type", STREAM_TYPE)
    return "" if kind == STREAM_TYPE else f"the caster has no such mountpoint (it sent {kind})"
