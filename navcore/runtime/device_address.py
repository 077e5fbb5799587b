"""Where a device is, in one line of text."""

from __future__ import annotations

from urllib.parse import SplitResult, urlsplit

from navcore.drivers.byte_source import ByteSource, SerialSource, TcpSource
from navcore.errors import ConfigError

USUAL_BAUD = 115200


class DeviceAddress:
    """`tcp://host:port` or `serial:///dev/ttyUSB0?115200`. Raises ConfigError for anything else."""

    def __init__(self, text: str) -> None:
        try:
            self._parts = _checked(urlsplit(text))
        except ValueError as error:
            raise ConfigError(
                f"'{text}' is no device. Write tcp://host:port or serial:///dev/ttyUSB0?115200."
            ) from error

    def open(self) -> ByteSource:
        """A new line to the device. Raises OSError while there is none."""
        parts = self._parts
        if parts.scheme == "tcp":
            return TcpSource(parts.hostname or "", parts.port or 0)
        return SerialSource(parts.path, int(parts.query or USUAL_BAUD))


def _checked(parts: SplitResult) -> SplitResult:
    """Raises ValueError."""
    on_network = parts.scheme == "tcp" and parts.hostname and parts.port
    at_port = parts.scheme == "serial" and parts.path and int(parts.query or USUAL_BAUD) > 0
    if not (on_network or at_port):
        raise ValueError(parts.geturl())
    return parts
