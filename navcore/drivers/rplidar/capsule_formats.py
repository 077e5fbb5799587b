"""Rays of a capsule, by format: distances in m, and by how much each ray points behind its place in the capsule."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from navcore.drivers.rplidar.protocol import Answer
from navcore.drivers.rplidar.rays import Floats, Ints
from navcore.drivers.rplidar.ultra import ultra_distances

_QUARTER_MM = 0.25e-3
_MM = 1e-3


class Placed(NamedTuple):
    """Attributes:
    distance: (N,) m, 0 for none. behind: (N,) deg that each ray lies before its even place. quality: (N,).
    """

    distance: Floats
    behind: Floats
    quality: Ints


class CapsuleFormat(NamedTuple):
    """Attributes:
    start_at: byte of the start angle. rays: of the body, and of that of the capsule after it.
    """

    start_at: int
    rays: Callable[[bytes, bytes], Placed]


def _express(body: bytes, _after: bytes) -> Placed:
    """16 cabins of 5 bytes: two distances, whose low two bits and a nibble each are an angle's offset in 1/8 deg."""
    pairs, nibbles = _cabins(body)
    offsets: Ints = np.column_stack((nibbles & 0xF, nibbles >> 4)) | (pairs & 0x3) << 4
    distance = (pairs & 0xFFFC).astype(np.float64) * _QUARTER_MM
    return _placed(distance.ravel(), offsets.ravel().astype(np.float64) / 8.0)


def _dense(body: bytes, _after: bytes) -> Placed:
    """40 distances in mm, evenly placed."""
    distance = np.frombuffer(body, "<u2").astype(np.float64) * _MM
    return _placed(distance, np.zeros(len(distance)))


def _ultra(body: bytes, after: bytes) -> Placed:
    """32 words of three distances; the nearer an object, the more its ray lies behind (the optics' parallax)."""
    distance = ultra_distances(np.frombuffer(body, "<u4"), int.from_bytes(after[:4], "little")) * _MM
    return _placed(distance, parallax_deg(distance))


def parallax_deg(distance: Floats) -> Floats:
    """By how much a ray of those distances (m) lies behind its even place, deg (Slamtec's SDK)."""
    inverse = 98361.0 / np.maximum(distance / _QUARTER_MM, 1.0)
    near = np.degrees(np.radians(8.0) - (inverse * 64.0 + inverse**3 / 98304.0) / 65536.0)
    return np.where(distance >= 0.05, near, 7.5)


def _ultra_dense(body: bytes, _after: bytes) -> Placed:
    """32 cabins of 5 bytes: two values of 20 bits, whose low two bits tell the scale."""
    pairs, nibbles = _cabins(body)
    values = (pairs | np.column_stack((nibbles & 0xF, nibbles >> 4)) << 16).ravel()
    scale = values & 0x3
    steps = np.array((2, 3, 4, 5))[scale]
    bits = np.array((0xFFC, 0x1FFC, 0x3FFC, 0x7FFC))[scale]
    base = np.array((0.0, 2046.0, 8187.0, 24567.0))[scale]
    distance = (values & bits) * steps * _QUARTER_MM + base * _MM
    quality = (values >> (12 + scale)) << scale
    return Placed(np.where(values & bits, distance, 0.0), np.zeros(len(values)), quality)


def _cabins(body: bytes) -> tuple[Ints, Ints]:
    """Two words (N, 2) and a byte (N,) each."""
    cabins = np.frombuffer(body, np.dtype([("pair", "<u2", (2,)), ("nibbles", "u1")]))
    return cabins["pair"].astype(np.int64), cabins["nibbles"].astype(np.int64)


def _placed(distance: Floats, behind: Floats) -> Placed:
    return Placed(distance, behind, np.zeros(len(distance), dtype=np.int64))


FORMATS = {
    Answer.EXPRESS: CapsuleFormat(2, _express),
    Answer.DENSE: CapsuleFormat(2, _dense),
    Answer.ULTRA: CapsuleFormat(2, _ultra),
    Answer.ULTRA_DENSE: CapsuleFormat(8, _ultra_dense),
}
