"""A second ear on the simulated chassis' CAN bus: what reaches the chassis, stamped by the kernel."""

from __future__ import annotations

import time
from dataclasses import dataclass
from threading import Event, Lock, Thread

import can

from navcore.chassis.scout_can import Frame, decode_motion_command

WAIT_S = 0.1


@dataclass(frozen=True, slots=True)
class MotionFrame:
    """A motion frame (0x111). `stamp_ns` is the monotonic time at which the kernel handed it to all listeners."""

    stamp_ns: int
    v: float
    omega: float

    @property
    def is_zero(self) -> bool:
        """Stand still."""
        return self.v == 0.0 and self.omega == 0.0


class BusWitness:
    """Collects motion frames in a thread. The kernel's stamps make its own lateness harmless."""

    def __init__(self, group: str, port: int) -> None:
        self._bus = can.Bus(interface="udp_multicast", channel=group, port=port, hop_limit=0, fd=False)
        self._frames: list[MotionFrame] = []
        self._lock, self._ended = Lock(), Event()
        self._thread = Thread(target=self._listen, name="bus witness", daemon=True)
        self._thread.start()

    def frames(self, from_ns: int = 0) -> list[MotionFrame]:
        """Frames since then, in the order of their arrival."""
        with self._lock:
            return [frame for frame in self._frames if frame.stamp_ns >= from_ns]

    def close(self) -> None:
        """Stop listening."""
        self._ended.set()
        self._thread.join()
        self._bus.shutdown()

    def _listen(self) -> None:
        while not self._ended.is_set():
            message = self._bus.recv(WAIT_S)
            if message is None:
                continue
            age_ns = time.time_ns() - int(message.timestamp * 1e9)
            stamp_ns = time.monotonic_ns() - age_ns
            motion = decode_motion_command(Frame(message.arbitration_id, bytes(message.data)))
            if motion is not None:
                with self._lock:
                    self._frames.append(MotionFrame(stamp_ns, *motion))


def was_moving(frames: list[MotionFrame], click_ns: int) -> bool:
    """Whether the last frame before the click told the chassis to drive."""
    before = [frame for frame in frames if frame.stamp_ns < click_ns]
    return bool(before) and not before[-1].is_zero


def first_zero_after(frames: list[MotionFrame], click_ns: int) -> int | None:
    """When the chassis first got a zero after the click, None if never."""
    return next((frame.stamp_ns for frame in frames if frame.stamp_ns >= click_ns and frame.is_zero), None)
