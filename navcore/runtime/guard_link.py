"""The navigator's end of the guard's sockets. Nothing here waits."""

from __future__ import annotations

import contextlib
import socket

from navcore.chassis.protocol import (
    LONGEST_DATAGRAM,
    ChassisState,
    GuardRequest,
    MotionCommand,
    decode_state,
    encode_motion,
    encode_request,
)
from navcore.transport.endpoints import SOCKET_MODE, Endpoints

BURST = 64  # states at a time; 50 come in a second


class GuardLink:
    """Commands and requests out, chassis states in."""

    def __init__(self, endpoints: Endpoints) -> None:
        self._command = str(endpoints.guard_command)
        self._out = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._out.setblocking(False)
        self._in = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        self._in.setblocking(False)
        endpoints.chassis_state.unlink(missing_ok=True)
        self._in.bind(str(endpoints.chassis_state))
        endpoints.chassis_state.chmod(SOCKET_MODE)

    def receive(self) -> tuple[ChassisState, ...]:
        """States that have come since the last call, oldest first."""
        states = []
        for _ in range(BURST):
            try:
                datagram = self._in.recv(LONGEST_DATAGRAM)
            except OSError:
                break
            if (state := decode_state(datagram)) is not None:
                states.append(state)
        return tuple(states)

    def send(self, request: GuardRequest | None, command: MotionCommand | None, now_ns: int) -> None:
        """Hand over what was decided. A guard that does not listen shows by its silence, not here."""
        if request is not None:
            self._send(encode_request(request, now_ns))
        if command is not None:
            self._send(encode_motion(command))

    def _send(self, datagram: bytes) -> None:
        with contextlib.suppress(OSError):
            self._out.sendto(datagram, self._command)

    def close(self) -> None:
        """Hang up."""
        self._out.close()
        self._in.close()
