"""Small files of points, written here by hand as others write them."""

from __future__ import annotations

import struct

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.point_cloud import PointCloud

Floats = NDArray[np.float64]


def some_points(n: int = 40, seed: int = 3) -> PointCloud:
    """Steps of 1/8 m, which every form keeps exactly."""
    rng = np.random.default_rng(seed)
    return PointCloud(
        points=rng.integers(-400, 400, (n, 3)) / 8.0,
        times=-np.arange(n, dtype=np.float64)[::-1] / 1024.0,
        intensities=rng.integers(0, 256, n).astype(np.uint8),
        rings=rng.integers(0, 16, n).astype(np.uint8),
    )


def pcd(points: Floats, form: str = "binary", *, width: int | None = None, body: bytes | None = None) -> bytes:
    """x, y, z and a padding of three bytes in between."""
    n = len(points) if width is None else width
    header = (
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y _ z\nSIZE 4 4 1 4\nTYPE F F U F\nCOUNT 1 1 3 1\n"
        f"WIDTH {n}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {n}\nDATA {form}\n"
    )
    return header.encode() + (pcd_body(points, form) if body is None else body)


def pcd_body(points: Floats, form: str) -> bytes:
    if form == "ascii":
        return "".join(f"{x:.9g} {y:.9g} 0 0 0 {z:.9g}\n" for x, y, z in points).encode()
    singles = points.astype("<f4")
    if form == "binary":
        return b"".join(
            xy.tobytes() + bytes(3) + z.tobytes() for xy, z in zip(singles[:, :2], singles[:, 2:], strict=True)
        )
    raw = singles[:, 0].tobytes() + singles[:, 1].tobytes() + bytes(3 * len(points)) + singles[:, 2].tobytes()
    packed = lzf(raw)
    return struct.pack("<II", len(packed), len(raw)) + packed


def lzf(data: bytes) -> bytes:
    """LZF as its specification has it, greedy: a back reference wherever three bytes were seen before."""
    out, literals, at = bytearray(), bytearray(), 0
    while at < len(data):
        start = data.rfind(data[at : at + 3], max(0, at - 8191), at + 2) if at + 3 <= len(data) else -1
        if start < 0 or start >= at:
            literals.append(data[at])
            at += 1
            if len(literals) == 32:
                _flush(out, literals)
            continue
        _flush(out, literals)
        length = 3
        while at + length < len(data) and length < 264 and data[start + length] == data[at + length]:
            length += 1
        back = at - start - 1
        if length - 2 < 7:
            out += bytes(((length - 2) << 5 | back >> 8, back & 255))
        else:
            out += bytes((7 << 5 | back >> 8, length - 9, back & 255))
        at += length
    _flush(out, literals)
    return bytes(out)


def _flush(out: bytearray, literals: bytearray) -> None:
    if literals:
        out.append(len(literals) - 1)
        out += literals
        literals.clear()


def ply(points: Floats, form: str = "ascii", *, vertices: int | None = None) -> bytes:
    """A camera before the vertices, a colour after the coordinates, a face after all."""
    n = len(points) if vertices is None else vertices
    header = (
        f"ply\nformat {form} 1.0\ncomment by hand\nelement camera 1\nproperty float f\nelement vertex {n}\n"
        "property double x\nproperty double y\nproperty double z\nproperty uchar intensity\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    ).encode()
    if form == "ascii":
        return header + b"1.5\n" + "".join(f"{x} {y} {z} 7\n" for x, y, z in points).encode() + b"3 0 1 2\n"
    order = ">" if "big" in form else "<"
    rows = b"".join(struct.pack(f"{order}dddB", *p, 7) for p in points)
    return header + struct.pack(f"{order}f", 1.5) + rows + struct.pack(f"{order}Biii", 3, 0, 1, 2)


def kitti(points: Floats) -> bytes:
    return np.column_stack((points, np.full(len(points), 0.5))).astype("<f4").tobytes()
