"""Distances of an ultra capsule: per word a distance of 12 bits and two predicted from it, coarser the further away.

From Slamtec's SDK (`_ultraCapsuleToNormal`, variable bit scale).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.drivers.rplidar.rays import Floats, Ints

# Codes from `CODE` on mean `VALUE` mm and 2^`SHIFT` mm for each further code.
CODE = np.array((0, 512, 1280, 1792, 3328))
VALUE = np.array((0, 512, 2048, 4096, 16384))
SHIFT = np.array((0, 1, 2, 3, 4))
NO_ECHO = (-512, 511)


def ultra_distances(words: NDArray[np.uint32], word_after: int) -> Floats:
    """Distances (3 N,) in mm of words (N,), 0 for none; `word_after` is the first of the next capsule."""
    word = words.astype(np.int64)
    code = np.append(word & 0xFFF, word_after & 0xFFF)
    value, shift = decoded(code)
    here, after = value[:-1], value[1:]
    alone = (here == 0) & (after > 0)  # nothing came back here: both are predicted from the next one
    base, base_shift = np.where(alone, after, here), np.where(alone, shift[1:], shift[:-1])
    first = _predicted(_signed(word >> 12 & 0x3FF), base, base_shift)
    second = _predicted(_signed(word >> 22 & 0x3FF), after, shift[1:])
    return np.column_stack((here, first, second)).ravel().astype(np.float64)


def decoded(code: Ints) -> tuple[Ints, Ints]:
    """Distance, mm, and shift of codes (N,) of 12 bits."""
    level = np.searchsorted(CODE, code, side="right") - 1
    return VALUE[level] + ((code - CODE[level]) << SHIFT[level]), SHIFT[level]


def _signed(ten_bits: Ints) -> Ints:
    return np.where(ten_bits >= 512, ten_bits - 1024, ten_bits)


def _predicted(step: Ints, base: Ints, shift: Ints) -> Ints:
    no_echo = (step == NO_ECHO[0]) | (step == NO_ECHO[1])
    return np.where(no_echo, 0, np.maximum(base + (step << shift), 0))
