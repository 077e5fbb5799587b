"""Packets whose rays carry their own angles: the standard answer's five bytes, and the HQ answer's 96 rays."""

from __future__ import annotations

import struct
import zlib

import numpy as np

from navcore.drivers.rplidar.rays import Rays, clockwise

_HQ_SYNC = 0xA5
_HQ_RAYS = np.dtype([("angle", "<u2"), ("distance", "<u4"), ("quality", "u1"), ("flag", "u1")])


def standard_ray(data: bytes) -> Rays | None:
    """One ray of five bytes; None if its start bits or its check bit are wrong."""
    first, angle, distance = struct.unpack("<BHH", data)
    if first & 1 == first >> 1 & 1 or not angle & 1:
        return None
    return clockwise(
        np.array(((angle >> 1) / 64.0,)), np.array((distance / 4000.0,)), np.array((first >> 2,), dtype=np.int64)
    )


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
