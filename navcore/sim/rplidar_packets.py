"""Rays as an RPLIDAR packs them, in each of its formats."""

from __future__ import annotations

import struct
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from navcore.drivers.rplidar.capsule import seal_capsule, start_field
from navcore.drivers.rplidar.capsule_formats import parallax_deg
from navcore.drivers.rplidar.protocol import Answer
from navcore.drivers.rplidar.single_packets import hq_checksum
from navcore.drivers.rplidar.ultra import CODE, SHIFT, VALUE, decoded

Floats = NDArray[np.float64]
# Distance, m, in each clockwise direction, deg (N,); 0 for none.
Scene = Callable[[Floats], Floats]
RAYS = {
    Answer.STANDARD: 1, Answer.EXPRESS: 32, Answer.DENSE: 40, Answer.ULTRA: 96, Answer.ULTRA_DENSE: 64, Answer.HQ: 96,
}  # fmt: skip
_QUALITY = 47


def packet(kind: Answer, scene: Scene, start_deg: float, step_deg: float, *, begins: bool = False) -> bytes:
    """The rays from `start_deg` on, `step_deg` apart."""
    even = start_deg + step_deg * np.arange(RAYS[kind] + 1, dtype=np.float64)
    return _PACKETS[kind](scene, np.asarray(even, dtype=np.float64), begins)


def _standard(scene: Scene, even: Floats, _begins: bool) -> bytes:
    angle = round(even[0] % 360.0 * 64.0) % (360 * 64)
    start = even[0] % 360.0 < (even[1] - even[0])
    first = _QUALITY << 2 | (1 if start else 2)
    return struct.pack("<BHH", first, angle << 1 | 1, round(float(scene(even[:1])[0]) * 4000.0))


def _express(scene: Scene, even: Floats, begins: bool) -> bytes:
    """Rays point where they are; none lies behind its place."""
    quarters = np.round(scene(even[:-1]) * 4000.0).astype(np.int64) & 0xFFFC
    cabins = b"".join(struct.pack("<HHB", a, b, 0) for a, b in quarters.reshape(-1, 2))
    return seal_capsule(start_field(even[0], begins=begins) + cabins)


def _dense(scene: Scene, even: Floats, begins: bool) -> bytes:
    mm = np.round(scene(even[:-1]) * 1000.0).astype("<u2")
    return seal_capsule(start_field(even[0], begins=begins) + mm.tobytes())


def _ultra(scene: Scene, even: Floats, begins: bool) -> bytes:
    """Rays lie behind their places by the parallax of what they meet."""
    mm = np.round(_behind(scene, even) * 1000.0).astype(np.int64)
    code = _coded(mm[::3])
    value, shift = decoded(code)
    here, after = value[:-1], value[1:]
    alone = (here == 0) & (after > 0)
    base, base_shift = np.where(alone, after, here), np.where(alone, shift[1:], shift[:-1])
    first, second = _step(mm[1::3], base, base_shift), _step(mm[2::3], after, shift[1:])
    words = (code[:-1] | (first & 0x3FF) << 12 | (second & 0x3FF) << 22).astype("<u4")
    return seal_capsule(start_field(even[0], begins=begins) + words.tobytes())


def _behind(scene: Scene, even: Floats) -> Floats:
    """What the rays meet that lie behind their places by the parallax of what they meet, m."""
    met = scene(even)
    for _ in range(4):
        met = scene(even - parallax_deg(met))
    return met


def _coded(mm: NDArray[np.int64]) -> NDArray[np.int64]:
    level = np.searchsorted(VALUE, mm, side="right") - 1
    return np.asarray(CODE[level] + ((mm - VALUE[level]) >> SHIFT[level]))


def _step(mm: NDArray[np.int64], base: NDArray[np.int64], shift: NDArray[np.int64]) -> NDArray[np.int64]:
    """Difference to the base in its scale; no echo where it is too large, as the device does it."""
    step = (mm - base) >> shift
    return np.where((mm == 0) | (step < -511) | (step > 510), 511, step)


def _ultra_dense(scene: Scene, even: Floats, begins: bool) -> bytes:
    """The further away, the coarser: 2, 3, 4 and 5 mm."""
    mm = scene(even[:-1]) * 1000.0
    scale = np.searchsorted((2046.0, 8187.0, 24567.0), mm, side="right")
    base, step = np.array((0.0, 2046.0, 8187.0, 24567.0))[scale], np.array((2.0, 3.0, 4.0, 5.0))[scale]
    counts = np.minimum(np.round((mm - base) / step).astype(np.int64), (0x400 << scale) - 1)
    values = counts << 2 | scale | (_QUALITY >> scale) << (12 + scale)
    pairs = values.reshape(-1, 2)
    cabins = b"".join(struct.pack("<HHB", a & 0xFFFF, b & 0xFFFF, a >> 16 | b >> 16 << 4) for a, b in pairs)
    return seal_capsule(struct.pack("<IH", 0, 0) + start_field(even[0], begins=begins) + cabins)


def _hq(scene: Scene, even: Floats, _begins: bool) -> bytes:
    angles = np.round(even[:-1] % 360.0 * 16384.0 / 90.0).astype(np.int64) % 65536
    quarters = np.round(scene(even[:-1]) * 4000.0).astype(np.int64)
    rays = b"".join(struct.pack("<HIBB", a, d, _QUALITY, 0) for a, d in zip(angles, quarters, strict=True))
    content = b"\xa5" + bytes(8) + rays
    return content + struct.pack("<I", hq_checksum(content))


_PACKETS: dict[Answer, Callable[[Scene, Floats, bool], bytes]] = {
    Answer.STANDARD: _standard, Answer.EXPRESS: _express, Answer.DENSE: _dense, Answer.ULTRA: _ultra,
    Answer.ULTRA_DENSE: _ultra_dense, Answer.HQ: _hq,
}  # fmt: skip
