"""Slots between a reader's thread and the tick. Neither side ever waits."""

from __future__ import annotations

from collections import deque
from typing import Generic, TypeVar

T = TypeVar("T")


class Inbox(Generic[T]):
    """All that came since the last tick, oldest first. When it is full the oldest are lost."""

    def __init__(self, size: int) -> None:
        self._waiting: deque[T] = deque(maxlen=size)

    def put(self, item: T) -> None:
        """From the reader's thread."""
        self._waiting.append(item)

    def take(self) -> tuple[T, ...]:
        """From the tick."""
        taken = []
        while self._waiting:
            taken.append(self._waiting.popleft())
        return tuple(taken)
