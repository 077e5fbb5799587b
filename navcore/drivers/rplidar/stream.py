"""Bytes of an RPLIDAR, in any portions, to rays; what is no packet is passed over and counted, never guessed."""

from __future__ import annotations

from collections import Counter
from enum import StrEnum

import numpy as np

from navcore.drivers.rplidar.capsule import Capsule, open_capsule
from navcore.drivers.rplidar.capsule_formats import FORMATS
from navcore.drivers.rplidar.protocol import ANSWER_FLAGS, HEADER_BYTES, Answer, AnswerHeader, DeviceInfo, Health
from navcore.drivers.rplidar.rays import Rays, clockwise
from navcore.drivers.rplidar.single_packets import hq_rays, standard_rays


class Refused(StrEnum):
    """Why bytes were passed over."""

    NO_ANSWER = "no answer of an RPLIDAR begins here"
    BAD_PACKET = "checksum or check bit wrong"
    NO_PLACE = "rays without a capsule after them, which would tell where they lie"


class RplidarStream:
    """One device's answers. `refused` counts bytes (rays for NO_PLACE) by reason; `kind` is the stream's format.

    `info` and `health` are the newest answers to those requests.
    """

    def __init__(self) -> None:
        self.refused: Counter[Refused] = Counter()
        self.info: DeviceInfo | None = None
        self.health: Health | None = None
        self._buffer = bytearray()
        self._header: AnswerHeader | None = None
        self._before: Capsule | None = None

    @property
    def kind(self) -> Answer | None:
        """Format of the rays that stream now, None while none do."""
        return self._header.kind if self._header else None

    def feed(self, data: bytes) -> list[Rays]:
        """Rays of every packet that `data` completes."""
        self._buffer += data
        found: list[Rays] = []
        while (size := self._step(found)) > 0:
            del self._buffer[:size]
        return found

    def _step(self, found: list[Rays]) -> int:
        """Bytes that are done with; 0 where more must come first."""
        if self._header is None:
            return self._begin()
        if len(self._buffer) < self._header.size:
            return self._break_off()
        if self._header.kind is Answer.STANDARD:
            return self._run(self._header.size, found)
        rays = self._packet(bytes(self._buffer[: self._header.size]))
        if rays is None:
            return self._begin_anew()
        if len(rays.angle):
            found.append(rays)
        return self._header.size

    def _run(self, size: int, found: list[Rays]) -> int:
        """All standard packets at once: they hold one ray each, and come thousands of times a second."""
        rays = standard_rays(bytes(self._buffer))
        if not len(rays.angle):
            return self._begin_anew()
        found.append(rays)
        return size * len(rays.angle)

    def _begin(self) -> int:
        """Look for the beginning of an answer."""
        at = self._buffer.find(ANSWER_FLAGS)
        if at != 0:
            torn = self._buffer.endswith(ANSWER_FLAGS[:1])
            passed = at if at > 0 else len(self._buffer) - torn
            if passed:
                self.refused[Refused.NO_ANSWER] += passed
            return passed
        if len(self._buffer) < HEADER_BYTES:
            return 0
        header = AnswerHeader.read(bytes(self._buffer[:HEADER_BYTES]))
        if header is None:
            self.refused[Refused.NO_ANSWER] += len(ANSWER_FLAGS)
            return len(ANSWER_FLAGS)
        return self._open(header)

    def _open(self, header: AnswerHeader) -> int:
        """A stream goes on until another answer begins; a single answer ends a stream that was stopped before it."""
        if header.streams:
            self._header, self._before = header, None
            return HEADER_BYTES
        whole = HEADER_BYTES + header.size
        if len(self._buffer) < whole:
            return 0
        content = bytes(self._buffer[HEADER_BYTES:whole])
        if header.kind is Answer.INFO:
            self.info = DeviceInfo.read(content)
        elif header.kind is Answer.HEALTH:
            self.health = Health.read(content)
        self._header, self._before = None, None
        return whole

    def _break_off(self) -> int:
        """Another answer within what should be a packet: the stream was stopped in the middle of it."""
        at = self._buffer.find(ANSWER_FLAGS)
        if at < 0 or AnswerHeader.read(bytes(self._buffer[at : at + HEADER_BYTES])) is None:
            return 0
        self._header, self._before = None, None
        if at:
            self.refused[Refused.BAD_PACKET] += at
        return at or self._begin()

    def _begin_anew(self) -> int:
        """What should be a packet is none: another answer, or a byte that does not belong here."""
        self._before = None
        if AnswerHeader.read(bytes(self._buffer[:HEADER_BYTES])) is not None:
            return self._break_off()
        self.refused[Refused.BAD_PACKET] += 1
        return 1

    def _packet(self, data: bytes) -> Rays | None:
        """Rays of one packet, none for the first capsule of a sequence; None if it is no packet."""
        kind = self.kind
        if kind is Answer.HQ:
            return hq_rays(data)
        if kind not in FORMATS:
            return None
        capsule = open_capsule(data, FORMATS[kind].start_at)
        if capsule is None:
            return None
        before, self._before = self._before, capsule
        return self._between(kind, before, capsule)

    def _between(self, kind: Answer, before: Capsule | None, after: Capsule) -> Rays:
        """Rays of a capsule lie evenly between its own angle and the next one's."""
        if before is None:
            return _NO_RAYS
        placed = FORMATS[kind].rays(before.body, after.body)
        if after.begins:
            self.refused[Refused.NO_PLACE] += len(placed.distance)
            return _NO_RAYS
        step = (after.start_deg - before.start_deg) % 360.0 / len(placed.distance)
        even = before.start_deg + step * np.arange(len(placed.distance))
        return clockwise(even - placed.behind, placed.distance, placed.quality)


_NO_RAYS = clockwise(np.empty(0), np.empty(0))
