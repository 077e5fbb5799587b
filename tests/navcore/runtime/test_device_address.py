"""Where the receiver is."""

from __future__ import annotations

import socket

import pytest

from navcore.errors import ConfigError
from navcore.runtime.device_address import DeviceAddress

NO_RECEIVERS = (
    "", "tcp://", "tcp://host", "tcp://host:99999", "/dev/ttyUSB0", "serial://", "serial:///dev/ttyUSB0?fast",
    "serial:///dev/ttyUSB0?-1", "udp://host:1",
)  # fmt: skip


@pytest.mark.parametrize("text", NO_RECEIVERS)
def test_what_is_no_receiver_is_refused_with_an_example(text: str) -> None:
    with pytest.raises(ConfigError, match=r"Write tcp://host:port or serial:///dev/ttyUSB0\?115200"):
        DeviceAddress(text)


def test_a_receiver_on_the_network_is_opened() -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        source = DeviceAddress(f"tcp://127.0.0.1:{server.getsockname()[1]}").open()
        client, _ = server.accept()
        client.sendall(b"$GP")
        data = b""
        while not data:
            data = source.read()
        assert data == b"$GP"
        source.close()
        client.close()


def test_a_receiver_that_is_not_there_is_an_os_error() -> None:
    with pytest.raises(OSError, match="no-such-port"):
        DeviceAddress("serial:///dev/no-such-port").open()
