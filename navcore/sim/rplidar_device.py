"""A simulated RPLIDAR, byte for byte: it answers requests, and streams what stands around it while it scans."""

from __future__ import annotations

import struct

from navcore.drivers.rplidar.protocol import REQUEST_FLAG, SIZES, Answer, AnswerHeader, Command, checksum
from navcore.sim.rplidar_packets import RAYS, Scene, packet

_PAYLOAD_AT = 3
_INFO = struct.pack("<BBBB", 0x41, 2, 1, 18) + bytes(range(16))


class RplidarDevice:
    """Streams in format `kind`, `rays_per_s` of them, turning `hz` times a second. `scene` may be changed any time.

    `faulty` makes its health an error: it then refuses to scan, as the real one does.
    """

    def __init__(self, scene: Scene, kind: Answer, *, rays_per_s: float = 8000.0, hz: float = 10.0) -> None:
        self.scene, self.kind, self.faulty = scene, kind, False
        self.scanning = False
        self._step_deg = 360.0 * hz / rays_per_s
        self._rays_per_s = rays_per_s
        self._angle = 0.0
        self._owed = 0.0
        self._begins = True

    def receive(self, data: bytes) -> bytes:
        """The answer to a request; nothing for one that is torn or unknown."""
        if len(data) < 2 or data[0] != REQUEST_FLAG or not _sound(data):
            return b""
        if data[1] == Command.GET_INFO:
            return _single(Answer.INFO, _INFO)
        if data[1] == Command.GET_HEALTH:
            return _single(Answer.HEALTH, struct.pack("<BH", 2 if self.faulty else 0, 0x8001 if self.faulty else 0))
        if data[1] in (Command.SCAN, Command.EXPRESS_SCAN):
            return self._start()
        if data[1] in (Command.STOP, Command.RESET):
            self.scanning = False
        return b""

    def _start(self) -> bytes:
        if self.faulty:
            return b""
        self.scanning, self._begins = True, True
        return AnswerHeader(self.kind, SIZES[self.kind], streams=True).bytes()

    def run(self, seconds: float) -> bytes:
        """What it sends in that time."""
        if not self.scanning:
            return b""
        self._owed += seconds * self._rays_per_s
        sent = b""
        while self._owed >= RAYS[self.kind]:
            sent += packet(self.kind, self.scene, self._angle, self._step_deg, begins=self._begins)
            self._angle = (self._angle + RAYS[self.kind] * self._step_deg) % 360.0
            self._owed -= RAYS[self.kind]
            self._begins = False
        return sent


def _sound(data: bytes) -> bool:
    """Requests with a payload carry a checksum."""
    if not data[1] & 0x80:
        return True
    return len(data) > _PAYLOAD_AT and len(data) == data[2] + 4 and checksum(data[:-1]) == data[-1]


def _single(kind: Answer, content: bytes) -> bytes:
    return AnswerHeader(kind, len(content), streams=False).bytes() + content
