"""The short way to a stop: from the web straight to the guard, past navigator, queue and database."""

from __future__ import annotations

import os
import socket
import time
from typing import Self

from navcore.chassis.protocol import encode_stop, is_stop_acknowledgement
from navcore.errors import TransportError
from navcore.transport.endpoints import SOCKET_MODE, Endpoints

TRIES = 3


class StopClient:
    """Sends STOP to the guard and waits until it says that it has latched. For one thread at a time."""

    def __init__(self, endpoints: Endpoints) -> None:
        self._guard = str(endpoints.guard_stop)
        self._own = endpoints.socket(f"stop_{os.getpid()}_{id(self):x}")
        self._socket = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._socket.bind(str(self._own))
        self._own.chmod(SOCKET_MODE)

    def stop(self, timeout_s: float = 0.1) -> None:
        """Stop the robot. Raises TransportError if the guard did not confirm, `timeout_s` being per try, s."""
        for _ in range(TRIES):
            number = time.monotonic_ns()
            if self._send(encode_stop(number)) and self._confirmed(number, timeout_s):
                return
        raise TransportError("The guard did not confirm the stop. Use the emergency stop on the robot.")

    def _send(self, datagram: bytes) -> bool:
        try:
            self._socket.sendto(datagram, self._guard)
        except OSError:  # no guard, or its queue is full
            return False
        return True

    def _confirmed(self, number: int, timeout_s: float) -> bool:
        deadline = time.monotonic() + timeout_s
        while (left := deadline - time.monotonic()) > 0:
            self._socket.settimeout(left)
            try:
                answer = self._socket.recv(64)
            except TimeoutError:
                return False
            if is_stop_acknowledgement(answer, number):
                return True
        return False

    def close(self) -> None:
        """Remove the socket."""
        self._socket.close()
        self._own.unlink(missing_ok=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
