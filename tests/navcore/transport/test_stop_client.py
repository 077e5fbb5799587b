"""The short way to a stop."""

from __future__ import annotations

import socket
import threading

import pytest

from navcore.chassis.protocol import answer_stop, encode_stop
from navcore.errors import TransportError
from navcore.transport.endpoints import Endpoints
from navcore.transport.stop_client import StopClient


def stand_in_guard(endpoints: Endpoints, deaf_to: int = 0) -> socket.socket:
    guard = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
    guard.bind(str(endpoints.guard_stop))
    guard.settimeout(5.0)

    def listen() -> None:
        for _ in range(deaf_to):
            guard.recvfrom(64)
        datagram, sender = guard.recvfrom(64)
        answer = answer_stop(datagram)
        assert answer is not None
        guard.sendto(answer_stop(encode_stop(1)) or b"", sender)
        guard.sendto(answer, sender)

    threading.Thread(target=listen, daemon=True).start()
    return guard


@pytest.mark.parametrize("deaf_to", [0, 1, 2])
def test_stop_is_repeated_until_the_guard_confirms_this_very_stop(endpoints: Endpoints, deaf_to: int) -> None:
    guard = stand_in_guard(endpoints, deaf_to)
    with StopClient(endpoints) as client:
        client.stop(timeout_s=0.3)
    guard.close()


def test_a_silent_guard_is_told_to_the_operator(endpoints: Endpoints) -> None:
    with socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as guard, StopClient(endpoints) as client:
        guard.bind(str(endpoints.guard_stop))
        with pytest.raises(TransportError, match="emergency stop"):
            client.stop(timeout_s=0.02)


def test_a_missing_guard_is_told_to_the_operator(endpoints: Endpoints) -> None:
    with StopClient(endpoints) as client, pytest.raises(TransportError, match="emergency stop"):
        client.stop()


def test_the_client_leaves_no_socket_behind(endpoints: Endpoints) -> None:
    with StopClient(endpoints):
        assert len(list(endpoints.directory.iterdir())) == 1
    assert list(endpoints.directory.iterdir()) == []
