"""Datagrams that a device sends to this computer."""

from __future__ import annotations

import select
import socket
from collections.abc import Sequence

from navcore.drivers.byte_source import WAIT_S

LONGEST_BYTES = 65_535
# A second of a LiDAR's packets, for a reader that is held up; the kernel may grant less.
BUFFER_BYTES = 2_000_000
MOST_STRANGERS = 16


class UdpSource:
    """Ports of this computer that a device sends to; `read` gives one datagram at a time.

    Attributes:
        strangers: datagrams of other senders, which are passed over, by address.

    Args:
        address: of the network card, "0.0.0.0" for every one.
        ports: where the device sends to; 0 for any that is free.
        sender: the device's own address, empty for any.
    """

    def __init__(self, address: str, ports: Sequence[int], sender: str = "") -> None:
        self._sender = sender
        self.strangers: dict[str, int] = {}
        self._sockets: list[socket.socket] = []
        try:
            for port in ports:
                self._sockets.append(_bound(address, port))
        except OSError:
            self.close()
            raise

    @property
    def ports(self) -> tuple[int, ...]:
        """Those that are open, in the order in which they were asked for."""
        return tuple(each.getsockname()[1] for each in self._sockets)

    def read(self) -> bytes:
        """A datagram, empty if none came within WAIT_S seconds."""
        for ready in select.select(self._sockets, (), (), WAIT_S)[0]:
            data, (host, _) = ready.recvfrom(LONGEST_BYTES)
            if not self._sender or host == self._sender:
                return bytes(data)
            if host in self.strangers or len(self.strangers) < MOST_STRANGERS:
                self.strangers[host] = self.strangers.get(host, 0) + 1
        return b""

    def write(self, data: bytes) -> None:
        """Nothing is ever asked of such a device."""
        raise OSError("a device that sends datagrams takes no commands")

    def close(self) -> None:
        """Give the ports back."""
        for each in self._sockets:
            each.close()


def _bound(address: str, port: int) -> socket.socket:
    """Raises OSError with a sentence."""
    bound = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        bound.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER_BYTES)
        bound.bind((address, port))
    except OSError as error:
        bound.close()
        raise OSError(
            f"UDP port {port} at {address} cannot be opened: {error.strerror or error}; does another program use it?"
        ) from error
    return bound
