"""NTRIP corrections from a caster."""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import pytest

from navcore.drivers import ntrip
from navcore.drivers.ntrip import NtripClient, NtripParams, checked_address
from navcore.errors import ConfigError

HEADER = (
    b"HTTP/1.1 200 OK\r\nNtrip-Version: Ntrip/2.0\r\nContent-Type: gnss/data\r\nTransfer-Encoding: chunked\r\n\r\n"
)


@contextmanager
def caster(answer: bytes, packet: int, requests: list[bytes]) -> Iterator[int]:
    """A caster on a port of this machine that sends its answer in packets, then stays silent."""
    stop = threading.Event()

    def serve() -> None:
        while not stop.is_set():
            try:
                connection, _ = server.accept()
            except OSError:
                return
            with connection:
                requests.append(connection.recv(4096))
                with suppress(OSError):  # a client that has enough hangs up
                    for at in range(0, len(answer), packet):
                        connection.sendall(answer[at : at + packet])
                stop.wait(20.0)

    with socket.create_server(("127.0.0.1", 0)) as server:
        threading.Thread(target=serve, daemon=True).start()
        yield server.getsockname()[1]
        stop.set()


def received(port: int, count: int, params: NtripParams | None = None) -> tuple[list[bytes], NtripClient]:
    messages: list[bytes] = []
    here = params or NtripParams(
        host="127.0.0.1", port=port, mountpoint="BASE", user="u", password="p", allow_local=True
    )
    client = NtripClient(here, messages.append)
    client.start()
    deadline = time.monotonic() + 20.0
    while len(messages) < count and client.problem in ("", "not connected yet") and time.monotonic() < deadline:
        time.sleep(0.005)
    client.stop()
    return messages, client


def unchunked(body: bytes) -> bytes:
    """What a chunked recording carries, up to its last whole chunk."""
    found, at = b"", 0
    while (end := body.find(b"\r\n", at)) >= 0:
        size = int(body[at:end], 16)
        found += body[end + 2 : end + 2 + size]
        at = end + 2 + size + 2
    return found


def crc24q(data: bytes) -> int:
    """RTCM 10403.3, section 4; zero over a whole message with its own checksum."""
    crc = 0
    for byte in data:
        crc ^= byte << 16
        for _ in range(8):
            crc = (crc << 1) ^ (0x1864CFB if crc & 0x800000 else 0)
    return crc & 0xFFFFFF


@pytest.mark.parametrize("packet", [1460, 97])
def test_recorded_chunked_stream_comes_out_as_whole_rtcm_messages(shared_data: Path, packet: int) -> None:
    body = (shared_data / "gnss/semuconsulting/ntrip_chunked.bin").read_bytes()
    requests: list[bytes] = []
    with caster(HEADER + body, packet, requests) as port:
        messages, _ = received(port, 50)
    assert len(messages) >= 50
    assert all(crc24q(message) == 0 for message in messages)
    assert requests[0].startswith(b"GET /BASE HTTP/1.1\r\n")
    assert b"Authorization: Basic dTpw\r\n" in requests[0]


def test_caster_of_the_first_revision_is_understood(shared_data: Path) -> None:
    rtcm = unchunked((shared_data / "gnss/semuconsulting/ntrip_chunked.bin").read_bytes())
    with caster(b"ICY 200 OK\r\n\r\n" + rtcm, 1460, []) as port:
        messages, _ = received(port, 50)
    assert len(messages) >= 50
    assert all(crc24q(message) == 0 for message in messages)


@pytest.mark.parametrize(
    ("answer", "word"),
    [
        (b"HTTP/1.1 401 Unauthorized\r\nContent-Length: 0\r\n\r\n", "401"),
        (b"HTTP/1.1 302 Found\r\nLocation: http://127.0.0.1:1/x\r\nContent-Length: 0\r\n\r\n", "302"),
        (b"HTTP/1.1 200 OK\r\nContent-Type: gnss/sourcetable\r\nContent-Length: 0\r\n\r\n", "no such mountpoint"),
        (b"SOURCETABLE 200 OK\r\n\r\n", "SOURCETABLE"),
    ],
)
def test_refusal_and_redirect_of_the_caster_are_told_and_not_followed(answer: bytes, word: str) -> None:
    with caster(answer, 1460, []) as port:
        messages, client = received(port, 1)
    assert messages == []
    assert word in client.problem


def test_lost_stream_is_opened_again(shared_data: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ntrip, "RECONNECT_S", 0.01)
    monkeypatch.setattr(ntrip, "SILENCE_S", 0.2)
    rtcm = unchunked((shared_data / "gnss/semuconsulting/ntrip_chunked.bin").read_bytes())
    requests: list[bytes] = []
    with caster(b"HTTP/1.1 200 OK\r\nContent-Type: gnss/data\r\n\r\n" + rtcm, 1460, requests) as port:
        client = NtripClient(
            NtripParams(host="127.0.0.1", port=port, mountpoint="BASE", allow_local=True), lambda _: None
        )
        client.start()
        deadline = time.monotonic() + 20.0
        while client.problem != "timed out" and time.monotonic() < deadline:
            time.sleep(0.005)
        client.stop()
    assert client.received >= 1


@pytest.mark.parametrize("host", ["127.0.0.1", "localhost", "169.254.169.254", "0.0.0.0", "::1"])
def test_this_machine_is_no_caster(host: str) -> None:
    with pytest.raises(ConfigError):
        checked_address(host, 2101, allow_local=False)


@pytest.mark.parametrize(
    ("host", "mountpoint"), [("", "M"), ("caster.example", ""), ("caster.example", "M HTTP\r\nX:")]
)
def test_configuration_that_names_no_stream_is_refused(host: str, mountpoint: str) -> None:
    with pytest.raises(ConfigError):
        NtripParams(host=host, mountpoint=mountpoint)
