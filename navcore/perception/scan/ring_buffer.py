"""Pictures and scans of the last seconds, and the trigger that pairs them (paper B, 2.2)."""

from __future__ import annotations

import bisect
import math
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

from navcore.errors import ConfigError


class Stamped(Protocol):
    """Whatever was captured at a known time."""

    @property
    def stamp_ns(self) -> int:
        """Monotonic time of capture."""
        ...


Item = TypeVar("Item", bound=Stamped)
Frame = TypeVar("Frame", bound=Stamped)
Scan = TypeVar("Scan", bound=Stamped)


@dataclass(frozen=True, slots=True, kw_only=True)
class SensorPairingParams:
    """Attributes:
    window_s: so long pictures and scans are kept, s, > 0 (paper B: 5).
    period_s: of the trigger, s, > 0 (paper B: 0.1).
    most_apart_s: a picture and a scan further apart are no pair, s, > 0. Ours: half a turn at 5 Hz, and a late one.
    """

    window_s: float = 5.0
    period_s: float = 0.1
    most_apart_s: float = 0.15

    def __post_init__(self) -> None:
        if not all(0.0 < s < math.inf for s in (self.window_s, self.period_s, self.most_apart_s)):
            raise ConfigError("The pairing of camera and LiDAR needs a window, a period and a limit above 0 s.")


@dataclass(frozen=True, slots=True)
class SensorPair(Generic[Frame, Scan]):
    """A picture and the scan nearest to it in time. apart_s: scan after picture, s."""

    frame: Frame
    scan: Scan

    @property
    def apart_s(self) -> float:
        """How much later the scan was taken, s."""
        return (self.scan.stamp_ns - self.frame.stamp_ns) / 1e9


class RingBuffer(Generic[Item]):
    """In order of their stamps, whatever order they come in; of the same stamp the newest stays."""

    def __init__(self, window_s: float) -> None:
        self._window_ns = round(window_s * 1e9)
        self._items: list[Item] = []
        self._stamps: list[int] = []

    def __len__(self) -> int:
        return len(self._items)

    def push(self, item: Item) -> None:
        """Keep an item, and drop those that are older than the newest by more than the window."""
        at = bisect.bisect_left(self._stamps, item.stamp_ns)
        if at < len(self._stamps) and self._stamps[at] == item.stamp_ns:
            self._items[at] = item
        else:
            self._items.insert(at, item)
            self._stamps.insert(at, item.stamp_ns)
        self.expire(self._stamps[-1])

    def expire(self, now_ns: int) -> None:
        """Drop what is older than the window."""
        gone = bisect.bisect_left(self._stamps, now_ns - self._window_ns)
        del self._items[:gone], self._stamps[:gone]

    def newest(self) -> Item | None:
        """None if it is empty."""
        return self._items[-1] if self._items else None

    def nearest(self, stamp_ns: int) -> Item | None:
        """The item nearest in time, the earlier one of two; None if it is empty."""
        return min(self._items, key=lambda item: abs(item.stamp_ns - stamp_ns), default=None)


class SensorPairing(Generic[Frame, Scan]):
    """At most one pair a period: the newest picture with the scan nearest to it, or why there is none."""

    def __init__(self, params: SensorPairingParams) -> None:
        self._params = params
        self.frames: RingBuffer[Frame] = RingBuffer(params.window_s)
        self.scans: RingBuffer[Scan] = RingBuffer(params.window_s)
        self._due_ns: int | None = None
        self._paired_ns: int | None = None

    def trigger(self, now_ns: int) -> SensorPair[Frame, Scan] | str | None:
        """The pair that is due; a short sentence if it cannot be had; None before it is due or without a new picture.

        `now_ns` is monotonic and on the clock of the stamps.
        """
        if self._due_ns is not None and now_ns < self._due_ns:
            return None
        self._due_ns = self._next_ns(now_ns)
        self.frames.expire(now_ns)
        self.scans.expire(now_ns)
        frame = self.frames.newest()
        if frame is None:
            return f"no picture for {self._params.window_s:.0f} s: is the camera plugged in?"
        if frame.stamp_ns == self._paired_ns:
            return None
        self._paired_ns = frame.stamp_ns
        return self._paired(frame)

    def _next_ns(self, now_ns: int) -> int:
        """One period after this one was due, so that late calls do not add up; after a pause, one after now."""
        period_ns = round(self._params.period_s * 1e9)
        due = now_ns if self._due_ns is None else self._due_ns
        return due + period_ns if now_ns - due < period_ns else now_ns + period_ns

    def _paired(self, frame: Frame) -> SensorPair[Frame, Scan] | str:
        scan = self.scans.nearest(frame.stamp_ns)
        if scan is None:
            return f"no LiDAR scan for {self._params.window_s:.0f} s: is it plugged in and turning?"
        pair = SensorPair(frame, scan)
        if abs(pair.apart_s) > self._params.most_apart_s:
            return f"camera and LiDAR are out of step by {abs(pair.apart_s):.1f} s"
        return pair
