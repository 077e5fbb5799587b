"""What is asked of an RPLIDAR, and how its answers begin (interface protocol: request and response packets)."""

from __future__ import annotations

import struct
from dataclasses import dataclass
from enum import IntEnum
from functools import reduce
from operator import xor
from typing import Self

REQUEST_FLAG = 0xA5
ANSWER_FLAGS = b"\xa5\x5a"
HEADER_BYTES = 7
_WITH_PAYLOAD = 0x80
_LENGTH_BITS = 30


class Command(IntEnum):
    """Requests."""

    STOP = 0x25
    RESET = 0x40
    SCAN = 0x20
    FORCE_SCAN = 0x21
    EXPRESS_SCAN = 0x82
    GET_INFO = 0x50
    GET_HEALTH = 0x52
    MOTOR_RPM = 0xA8


class Answer(IntEnum):
    """Kinds of answers: two single ones, and six streams of rays."""

    INFO = 0x04
    HEALTH = 0x06
    STANDARD = 0x81
    EXPRESS = 0x82
    HQ = 0x83
    ULTRA = 0x84
    DENSE = 0x85
    ULTRA_DENSE = 0x86


# Bytes of one packet of each kind.
SIZES = {
    Answer.INFO: 20, Answer.HEALTH: 3, Answer.STANDARD: 5, Answer.EXPRESS: 84, Answer.HQ: 781, Answer.ULTRA: 132,
    Answer.DENSE: 84, Answer.ULTRA_DENSE: 170,
}  # fmt: skip


def request(command: Command, payload: bytes = b"") -> bytes:
    """The bytes of a request; commands from 0x80 on carry a payload, its size and a checksum."""
    head = bytes((REQUEST_FLAG, command))
    if not command & _WITH_PAYLOAD:
        return head
    packet = head + bytes((len(payload),)) + payload
    return packet + bytes((checksum(packet),))


def express_scan(mode: int = 0) -> bytes:
    """Ask for rays in the format of that scan mode."""
    return request(Command.EXPRESS_SCAN, struct.pack("<BHH", mode, 0, 0))


def motor_speed(rpm: int) -> bytes:
    """Ask the motor to turn so fast, 0 to stop it."""
    return request(Command.MOTOR_RPM, struct.pack("<H", rpm))


def checksum(data: bytes) -> int:
    """All bytes, exclusive or."""
    return reduce(xor, data, 0)


@dataclass(frozen=True, slots=True)
class AnswerHeader:
    """Attributes:
    kind: of the answer. size: bytes of each of its packets. streams: packets follow until the device is stopped.
    """

    kind: Answer
    size: int
    streams: bool

    @classmethod
    def read(cls, data: bytes) -> Self | None:
        """From 7 bytes; None if they are no header of a kind that we know."""
        if len(data) < HEADER_BYTES or not data.startswith(ANSWER_FLAGS):
            return None
        word, kind = struct.unpack_from("<IB", data, len(ANSWER_FLAGS))
        size = word & ((1 << _LENGTH_BITS) - 1)
        if kind not in SIZES or size != SIZES[Answer(kind)]:
            return None
        return cls(Answer(kind), size, bool(word >> _LENGTH_BITS))

    def bytes(self) -> bytes:
        """As the device sends it."""
        return ANSWER_FLAGS + struct.pack("<IB", self.size | self.streams << _LENGTH_BITS, self.kind)


@dataclass(frozen=True, slots=True)
class DeviceInfo:
    """What answers GET_INFO."""

    model: int
    firmware: tuple[int, int]
    hardware: int
    serial: str

    @classmethod
    def read(cls, data: bytes) -> Self:
        """From 20 bytes."""
        model, minor, major, hardware = struct.unpack_from("<BBBB", data)
        return cls(model, (major, minor), hardware, data[4:20].hex().upper())


@dataclass(frozen=True, slots=True)
class Health:
    """What answers GET_HEALTH: status 0 good, 1 warning, 2 error, and the maker's code."""

    status: int
    code: int

    @classmethod
    def read(cls, data: bytes) -> Self:
        """From 3 bytes."""
        return cls(*struct.unpack("<BH", data))

    @property
    def words(self) -> str:
        """For the operator."""
        names = ("good", "warning", "error: stop the robot and restart the LiDAR")
        name = names[self.status] if self.status < len(names) else f"unknown status {self.status}"
        return f"LiDAR health: {name}" + (f", code {self.code}" if self.code else "")
