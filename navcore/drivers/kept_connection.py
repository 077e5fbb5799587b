"""A thread that keeps a device connected: what is lost is opened again."""

from __future__ import annotations

import threading
from collections.abc import Callable

from navcore.drivers.byte_source import ByteSource


class KeptConnection:
    """Opens, lets `use` talk until it returns or fails, and opens again until stopped.

    `source` is the open connection, None without one; `problem` a sentence, empty while all is well.

    Args:
        name: of the thread.
        open_source: opens the connection; OSError while there is none.
        use: talks over one connection while `going` holds; EOFError at the end of a recorded file ends the thread.
        reconnect_s: between two attempts, s.
    """

    def __init__(
        self, name: str, open_source: Callable[[], ByteSource], use: Callable[[ByteSource], None], reconnect_s: float
    ) -> None:
        self._open_source, self._use, self._reconnect_s = open_source, use, reconnect_s
        self._stopping = threading.Event()
        self._thread = threading.Thread(target=self._run, name=name, daemon=True)
        self.source: ByteSource | None = None
        self.problem = "not connected yet"
        self.connections = 0

    def start(self) -> None:
        """Begin to read."""
        self._thread.start()

    def stop(self) -> None:
        """End the thread and close the connection."""
        self._stopping.set()
        self._thread.join()

    @property
    def going(self) -> bool:
        """Not stopped yet."""
        return not self._stopping.is_set()

    def is_running(self) -> bool:
        """False once stopped or at the end of a recorded file."""
        return self._thread.is_alive()

    def _run(self) -> None:
        while self.going:
            try:
                self._use_one_connection()
            except EOFError:
                return
            except OSError as error:
                self.problem = str(error)
            self._stopping.wait(self._reconnect_s)

    def _use_one_connection(self) -> None:
        source = self._open_source()
        self.source = source
        self.connections += 1
        try:
            self._use(source)
        finally:
            self.source = None
            source.close()
