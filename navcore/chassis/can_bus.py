"""The CAN bus as the guard holds it: alone, one frame at a time, opened again after a failure."""

from __future__ import annotations

import socket
from typing import Any

import can

from navcore.chassis.scout_can import Frame

REOPEN_NS = 1_000_000_000
BUS_OFF = 0x40  # error class of linux/can/error.h
FAILURES = (can.CanError, OSError)


class OneBus:
    """The CAN bus, opened again after a failure. Opening it never moves anything: the guard stays latched."""

    def __init__(self, interface: str, channel: str, options: dict[str, int]) -> None:
        self._settings: dict[str, Any] = {"interface": interface, "channel": channel, **options}
        self._lock = socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM)
        try:  # an abstract name vanishes with its process, however that ends
            self._lock.bind(f"\0rowpilot-guard {interface} {channel} {sorted(options.items())}")
        except OSError:
            raise SystemExit(f"Another guard already holds {interface} {channel}. Stop it first.") from None
        self._bus: can.BusABC | None = None
        self._tried_ns = -REOPEN_NS

    def open_if_due(self, now_ns: int) -> None:
        """Open the bus unless it is open or was tried within the last second. Raises FAILURES."""
        if self._bus is None and now_ns - self._tried_ns >= REOPEN_NS:
            self._tried_ns = now_ns
            self._bus = can.Bus(**self._settings)

    def fileno(self) -> int | None:
        """For `poll`, None while there is no bus."""
        return None if self._bus is None else self._bus.fileno()

    def send(self, frame: Frame) -> None:
        """Raises FAILURES."""
        if self._bus is not None:
            message = can.Message(arbitration_id=frame.can_id, data=frame.data, is_extended_id=False)
            self._bus.send(message, timeout=0.01)

    def receive(self) -> Frame | None:
        """A frame that has arrived, None if there is none. Raises FAILURES."""
        message = None if self._bus is None else self._bus.recv(0.0)
        if message is None:
            return None
        if message.is_error_frame and message.arbitration_id & BUS_OFF:
            raise can.CanOperationError("bus off")
        ours = not (message.is_error_frame or message.is_extended_id or message.is_remote_frame)
        return Frame(message.arbitration_id if ours else 0, bytes(message.data))

    def drop(self) -> None:
        """Close the bus until `open_if_due` opens it again."""
        if self._bus is not None:
            self._bus.shutdown()
            self._bus = None

    def close(self) -> None:
        """Let go of the bus for good."""
        self.drop()
        self._lock.close()
