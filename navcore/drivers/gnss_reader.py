"""A thread that keeps a receiver connected and hands out its fixes."""

from __future__ import annotations

from collections.abc import Callable

from navcore.drivers.byte_source import ByteSource
from navcore.drivers.kept_connection import KeptConnection
from navcore.drivers.nmea_stream import NmeaStream
from navcore.messages import GnssFix

RECONNECT_S = 1.0


class GnssReader(KeptConnection):
    """Reads until stopped; a lost connection is opened again every second.

    Args:
        open_source: opens the connection; OSError while there is none.
        stream: assembles the epochs; used by the reader's thread alone.
        deliver: called in that thread with each fix.
        clock: monotonic time in ns.
    """

    def __init__(
        self,
        open_source: Callable[[], ByteSource],
        stream: NmeaStream,
        deliver: Callable[[GnssFix], None],
        clock: Callable[[], int],
    ) -> None:
        self._stream, self._deliver, self._clock = stream, deliver, clock
        super().__init__("gnss-reader", open_source, self._read, RECONNECT_S)

    def correct(self, data: bytes) -> None:
        """Pass corrections on to the receiver; without a connection they are dropped, as they age in seconds."""
        source = self.source
        if source is None:
            return
        try:
            source.write(data)
        except OSError as error:
            self.problem = f"corrections not taken: {error}"

    def _read(self, source: ByteSource) -> None:
        self.problem = ""
        try:
            while self.going:
                self._hand_out(self._stream.feed(source.read(), self._clock()))
        except EOFError:
            self._hand_out(self._stream.flush(self._clock()))
            raise

    def _hand_out(self, fixes: list[GnssFix]) -> None:
        for fix in fixes:
            self._deliver(fix)
