"""VLP-16 and C16 packets decoded once more, ray by ray, straight from the makers' formulas: slow, and on its own."""

from __future__ import annotations

import struct
from math import cos, radians, sin
from typing import NamedTuple

# VLP-16 manual, table 9-1: laser id -> vertical angle (deg), vertical correction (mm).
VLP16_LASERS = (
    (-15, 11.2), (1, -0.7), (-13, 9.7), (3, -2.2), (-11, 8.1), (5, -3.7), (-9, 6.6), (7, -5.1), (-7, 5.1), (9, -6.6),
    (-5, 3.7), (11, -8.1), (-3, 2.2), (13, -9.7), (-1, 0.7), (15, -11.2),
)  # fmt: skip
C16_LASERS = {
    "c16": (-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15),
    "c16-fine": (-10, 0.665, -8.665, 2, -7.33, 3.33, -6, 4.665, -4.665, 6, -3.33, 7.33, -2, 8.665, -0.665, 10),
}


class PlainRay(NamedTuple):
    """turned: deg clockwise, within [0, 360) or a little more. us: device time. xyz: m, None without an echo."""

    turned: float
    us: float
    xyz: tuple[float, float, float] | None
    intensity: int
    laser: int


def _blocks(payload: bytes) -> list[tuple[int, list[tuple[int, int]]]]:
    """Azimuth (1/100 deg) and 32 x (distance, intensity) of each block."""
    blocks = []
    for n in range(12):
        flag, azimuth = struct.unpack_from("<HH", payload, n * 100)
        assert flag == 0xEEFF
        blocks.append((azimuth, [struct.unpack_from("<HB", payload, n * 100 + 4 + i * 3) for i in range(32)]))
    return blocks


def _gap(blocks: list[tuple[int, list[tuple[int, int]]]], n: int, apart: int) -> float:
    """deg from block n to the one `apart` later; at a packet's end as it was before."""
    if n + apart >= len(blocks):
        return _gap(blocks, n - apart, apart)
    return (blocks[n + apart][0] - blocks[n][0]) % 36000 / 100.0


def plain_vlp16(payload: bytes) -> list[PlainRay]:
    """All rays of a single-return packet. The manual's Y looks forward and its X to the right."""
    blocks, (stamp,) = _blocks(payload), struct.unpack_from("<I", payload, 1200)
    rays = []
    for n, (azimuth, channels) in enumerate(blocks):
        for k, (distance, intensity) in enumerate(channels):
            laser, firing = k % 16, k // 16
            passed = firing * 55.296 + laser * 2.304
            alpha = azimuth / 100.0 + _gap(blocks, n, 1) * passed / 110.592
            omega, correction = VLP16_LASERS[laser]
            r, a, w = distance * 0.002, radians(alpha), radians(omega)
            right, forward, up = r * cos(w) * sin(a), r * cos(w) * cos(a), r * sin(w) + correction / 1000.0
            xyz = (forward, -right, up) if distance else None
            rays.append(PlainRay(alpha, stamp + n * 110.592 + passed, xyz, intensity, laser))
    return rays


def plain_c16(payload: bytes, model: str, lever: float, unit: float = 0.0025) -> list[PlainRay]:
    """All rays of a packet, single or dual; a second echo that is the first one once more is none."""
    blocks, dual = _blocks(payload), payload[-2] == 0x39
    (stamp,) = struct.unpack_from("<I", payload, len(payload) - 6)
    pairs, rays = (2, 600) if dual else (1, 1200), []
    apart, packet_us = pairs
    for n, (azimuth, channels) in enumerate(blocks):
        for i, (distance, intensity) in enumerate(channels):
            alpha = azimuth / 100.0 + _gap(blocks, n - n % apart, apart) * i / 32
            twice = n % apart == 1 and distance == blocks[n - 1][1][i][0]
            r, a, v = distance * unit, radians(alpha), radians(C16_LASERS[model][i % 16])
            beside = radians(14.67 - alpha)
            xyz = (
                r * cos(v) * cos(a) + lever * cos(beside),
                -r * cos(v) * sin(a) + lever * sin(beside),
                r * sin(v),
            )
            us = stamp - packet_us + 3.125 + n // apart * 100.0 + i * 3.125
            rays.append(PlainRay(alpha, us, None if r <= 0.2 or twice else xyz, intensity, i % 16))
    return rays
