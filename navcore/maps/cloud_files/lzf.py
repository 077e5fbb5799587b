"""LZF, the compression of PCD's `binary_compressed`: literals and back references, no header."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]
# A back reference of three bytes stands for 264 at most: what claims more is a lie.
LARGEST_GROWTH = 88


def decompress(packed: bytes, size: int) -> bytes | None:
    """The `size` bytes that were packed; None where the stream is broken or does not give exactly that many."""
    if size > LARGEST_GROWTH * len(packed):
        return None
    out = np.empty(size, dtype=np.uint8)
    return out.tobytes() if _decompress(np.frombuffer(packed, dtype=np.uint8), out) == size else None


@njit(cache=True)
def _decompress(packed: Bytes, out: Bytes) -> int:
    """Number of bytes written to `out`; -1 where a reference or a run leaves the stream."""
    at, to = 0, 0
    while at < len(packed):
        control = int(packed[at])
        at += 1
        if control < 32:
            run = control + 1
            if at + run > len(packed) or to + run > len(out):
                return -1
            out[to : to + run] = packed[at : at + run]
            at, to = at + run, to + run
            continue
        length = control >> 5
        if length == 7:
            if at >= len(packed):
                return -1
            length += int(packed[at])
            at += 1
        if at >= len(packed):
            return -1
        start = to - ((control & 31) << 8) - int(packed[at]) - 1
        at += 1
        length += 2
        if start < 0 or to + length > len(out):
            return -1
        for k in range(length):  # byte by byte: a reference may reach into what it writes
            out[to + k] = out[start + k]
        to += length
    return to
