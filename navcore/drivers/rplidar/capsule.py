"""Capsules: packets of rays that begin at a told angle and end where the next capsule begins."""

from __future__ import annotations

import struct
from typing import NamedTuple

from navcore.drivers.rplidar.protocol import checksum

_NEW_SEQUENCE = 0x8000
_SYNC = (0xA, 0x5)


class Capsule(NamedTuple):
    """Attributes:
    start_deg: clockwise angle at which its rays begin. begins: it follows no other one.
    body: its rays.
    """

    start_deg: float
    begins: bool
    body: bytes


def synced(data: bytes) -> bool:
    """Whether a capsule could begin here: the high nibbles of its first two bytes are A and 5."""
    return len(data) >= 2 and (data[0] >> 4, data[1] >> 4) == _SYNC


def open_capsule(data: bytes, start_at: int) -> Capsule | None:
    """The capsule whose start angle stands at that byte; None if its checksum, in the low nibbles, is wrong."""
    if not synced(data) or checksum(data[2:]) != (data[0] & 0xF) | (data[1] & 0xF) << 4:
        return None
    (start,) = struct.unpack_from("<H", data, start_at)
    return Capsule((start & ~_NEW_SEQUENCE) / 64.0, bool(start & _NEW_SEQUENCE), data[start_at + 2 :])


def seal_capsule(content: bytes) -> bytes:
    """As a device sends it: the bytes after the checksum, with the checksum before them."""
    told = checksum(content)
    return bytes((_SYNC[0] << 4 | told & 0xF, _SYNC[1] << 4 | told >> 4)) + content


def start_field(start_deg: float, *, begins: bool) -> bytes:
    """Start angle and new-sequence bit."""
    return struct.pack("<H", round(start_deg * 64.0) % (360 * 64) | (_NEW_SEQUENCE if begins else 0))
