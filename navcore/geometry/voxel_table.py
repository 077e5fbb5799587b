"""Where the voxel of a place is: a hash table with open addressing, in arrays that compiled code reads.

A voxel's key is its three indices, floor(coordinate / size), 21 bits each. `keys` (2^b,) holds keys or `FREE`,
`slots` (2^b,) the number of each key's voxel. At most half of the table is taken.
"""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Keys = NDArray[np.int64]
Slots = NDArray[np.int32]
FREE = -1
# Indices reach from -HALF to HALF - 1.
HALF = 1 << 20
_SPREAD = -7046029254386353131  # 2^64 over the golden ratio, odd, as a signed number


@njit(cache=True, inline="always")
def key_of(i: int, j: int, k: int) -> int:
    """Of a voxel's three indices, each within the table's reach."""
    return ((i + HALF) << 42) | ((j + HALF) << 21) | (k + HALF)


@njit(cache=True)
def find(keys: Keys, slots: Slots, key: int) -> int:
    """Number of the key's voxel; `FREE` if there is none."""
    mask = len(keys) - 1
    at = ((key * _SPREAD) >> 32) & mask
    while keys[at] != FREE:
        if keys[at] == key:
            return int(slots[at])
        at = (at + 1) & mask
    return FREE


@njit(cache=True)
def put(keys: Keys, slots: Slots, key: int, slot: int) -> None:
    """Enter a key that is not there yet; the table has room."""
    mask = len(keys) - 1
    at = ((key * _SPREAD) >> 32) & mask
    while keys[at] != FREE:
        at = (at + 1) & mask
    keys[at], slots[at] = key, slot


@njit(cache=True)
def table_of(voxel_keys: Keys, count: int, size: int) -> tuple[Keys, Slots]:
    """A table of `size`, a power of two at least twice `count`, of the first `count` voxels."""
    keys = np.full(size, FREE, dtype=np.int64)
    slots = np.full(size, FREE, dtype=np.int32)
    for slot in range(count):
        put(keys, slots, voxel_keys[slot], slot)
    return keys, slots
