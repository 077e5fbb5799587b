"""Colours of heights, the same in the 3D view and on the map."""

from __future__ import annotations

from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

HIGHEST = 4.0  # m above the ground, from where all is one colour


def height_colours(heights: NDArray[np.floating[Any]]) -> NDArray[np.uint8]:
    """(N, 3) red, green, blue of heights above the ground (N,), m: Turbo, which tells many steps apart."""
    if not len(heights):
        return np.zeros((0, 3), np.uint8)
    levels = np.asarray(255.0 * np.clip(heights / HIGHEST, 0.0, 1.0), dtype=np.uint8).reshape(-1, 1)
    return np.asarray(cv2.applyColorMap(levels, cv2.COLORMAP_TURBO).reshape(-1, 3)[:, ::-1])
