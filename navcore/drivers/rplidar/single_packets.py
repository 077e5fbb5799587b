"""Packets whose rays carry their own angles: the standard answer's five bytes, and the HQ answer's 96 rays."""

from __future__ import annotations

import struct
import zlib

import numpy as np

from navcore.drivers.rplidar.rays import Rays, clockwise

_HQ_SYNC = 0xA5
_STANDARD = np.dtype([("first", "u1"), ("angle", "<u2"), ("distance", "<u2")])
_HQ_RAYS = np.dtype([("angle", "<u2"), ("distance", "<u4"), ("quality", "u1"), ("flag", "u1")])


def standard_rays(data: bytes) -> Rays:
    """Rays of five bytes each, up to the first one whose start bits or check bit are wrong."""
    packets = np.frombuffer(data, _STANDARD, count=len(data) // _STANDARD.itemsize)
    first, angle = packets["first"].astype(np.int64), packets["angle"].astype(np.int64)
    wrong = (first & 1 == first >> 1 & 1) | (angle & 1 == 0)
    sound = int(np.argmax(wrong)) if wrong.any() else len(packets)
    distance = packets["distance"][:sound].astype(np.float64) / 4000.0
    return clockwise((angle[:sound] >> 1) / 64.0, distance, first[:sound] >> 2)


def hq_rays(data: bytes) -> Rays | None:
    """96 rays of 781 bytes; None if its checksum is wrong."""
    if data[0] != _HQ_SYNC or struct.unpack("<I", data[-4:])[0] != hq_checksum(data[:-4]):
        return None
    rays = np.frombuffer(data[9:-4], _HQ_RAYS)
    return clockwise(
        rays["angle"].astype(np.float64) * 90.0 / 16384.0, rays["distance"].astype(np.float64) / 4000.0,
        rays["quality"].astype(np.int64),
    )  # fmt: skip


def hq_checksum(data: bytes) -> int:
    """CRC-32 of the bytes, filled up with 1 to 4 zeros to whole words."""
    return zlib.crc32(data + bytes(4 - len(data) % 4))
