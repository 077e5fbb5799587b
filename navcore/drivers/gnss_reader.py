"""A thread that keeps a receiver connected and hands out its fixes."""

from __future__ import annotations

import threading
from collections.abc import Callable

from navcore.drivers.byte_source import ByteSource
from navcore.drivers.nmea_stream import NmeaStream
from navcore.messages import GnssFix

RECONNECT_S = 1.0


class GnssReader:
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
        self._open_source = open_source
        self._stream = stream
        self._deliver = deliver
        self._clock = clock
        self._source: ByteSource | None = None
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name="gnss-reader", daemon=True)
        self.problem = "not connected yet"
        self.connections = 0

    def start(self) -> None:
        """Begin to read."""
        self._thread.start()

    def stop(self) -> None:
        """End the thread and close the connection."""
        self._stopping.set()
        self._thread.join()

    def is_running(self) -> bool:
        """False once stopped or at the end of a recorded file."""
        return self._thread.is_alive()

    def correct(self, data: bytes) -> None:
        """Pass corrections on to the receiver; without a connection they are dropped, as they age in seconds."""
        source = self._source
        if source is None:
            return
        try:
            source.write(data)
        except OSError as error:
            self.problem = f"corrections not taken: {error}"

    def _run(self) -> None:
        while not self._stopping.is_set():
            try:
                self._read_one_connection()
            except EOFError:
                self._hand_out(self._stream.flush(self._clock()))
                return
            except OSError as error:
                self.problem = str(error)
            self._stopping.wait(RECONNECT_S)

    def _read_one_connection(self) -> None:
        source = self._open_source()
        self._source, self.problem = source, ""
        self.connections += 1
        try:
            while not self._stopping.is_set():
                data = source.read()
                self._hand_out(self._stream.feed(data, self._clock()))
        finally:
            self._source = None
            source.close()

    def _hand_out(self, fixes: list[GnssFix]) -> None:
        for fix in fixes:
            self._deliver(fix)
