"""Guo-Hall thinning of a mask (Guo and Hall 1989, algorithm A1): compiled, for no installed library has it."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Bytes = NDArray[np.uint8]


@njit(cache=True)
def thin(mask: Bytes) -> Bytes:
    """(H, W) of 0 and 1 -> (H, W): as connected as before, a pixel wide.

    The picture's edge is no edge of what it shows: a mask that reaches it is not worn off from there (OpenCV's
    thinning leaves the outermost pixels alone too). Ground without an edge in sight stays as it is, or wears off.

    Both passes mark first and delete then, so that the order in which pixels are looked at does not matter.
    """
    height, width = mask.shape
    padded = _continued(mask)
    marked = np.empty((height * width, 2), np.int64)
    deleted = 1
    while deleted > 0:
        deleted = 0
        for second in (False, True):
            count = _mark(padded, second, marked)
            for k in range(count):
                padded[marked[k, 0], marked[k, 1]] = 0
            deleted += count
    thinned: Bytes = padded[1:-1, 1:-1].copy()
    return thinned


@njit(cache=True)
def _continued(mask: Bytes) -> Bytes:
    """(H + 2, W + 2): the mask in a frame of its outermost pixels."""
    padded = np.zeros((mask.shape[0] + 2, mask.shape[1] + 2), np.uint8)
    padded[1:-1, 1:-1] = mask
    padded[0, 1:-1], padded[-1, 1:-1] = mask[0], mask[-1]
    padded[:, 0], padded[:, -1] = padded[:, 1], padded[:, -2]
    return padded


@njit(cache=True)
def _mark(padded: Bytes, second: bool, marked: NDArray[np.int64]) -> int:
    """Pixels that this pass deletes, into `marked`; how many."""
    count = 0
    for i in range(1, padded.shape[0] - 1):
        for j in range(1, padded.shape[1] - 1):
            if padded[i, j] and _deletable(padded, i, j, second):
                marked[count, 0], marked[count, 1] = i, j
                count += 1
    return count


@njit(cache=True)
def _deletable(p: Bytes, i: int, j: int, second: bool) -> bool:
    """C = 1, 2 <= N <= 3, and on the side that this pass takes away; neighbours P2 (north) to P9, clockwise."""
    p2, p3, p4, p5 = p[i - 1, j], p[i - 1, j + 1], p[i, j + 1], p[i + 1, j + 1]
    p6, p7, p8, p9 = p[i + 1, j], p[i + 1, j - 1], p[i, j - 1], p[i - 1, j - 1]
    crossings = (
        (1 - p2) * (p3 | p4) + (1 - p4) * (p5 | p6) + (1 - p6) * (p7 | p8) + (1 - p8) * (p9 | p2)
    )  # fmt: skip
    if crossings != 1:
        return False
    n1, n2 = (p9 | p2) + (p3 | p4) + (p5 | p6) + (p7 | p8), (p2 | p3) + (p4 | p5) + (p6 | p7) + (p8 | p9)
    if not 2 <= min(n1, n2) <= 3:
        return False
    inner = (p2 | p3 | (1 - p5)) & p4 if second else (p6 | p7 | (1 - p9)) & p8
    return bool(inner == 0)
