"""A thread of the station that works beside the requests."""

from __future__ import annotations

from abc import ABC, abstractmethod
from threading import Event, Thread


class Worker(ABC):
    """Works from `start` to `close`; once each."""

    def __init__(self, name: str) -> None:
        self._closing = Event()
        self._thread = Thread(target=self._work, name=name, daemon=True)

    @abstractmethod
    def _work(self) -> None:
        """All of the work, until `self._closing` is set."""

    def start(self) -> None:
        """Begin."""
        self._thread.start()

    def close(self) -> None:
        """End, and wait for the end; also right for a worker that never began."""
        self._closing.set()
        if self._thread.is_alive():
            self._thread.join()
