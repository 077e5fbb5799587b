"""Scans of round trunks, exact but for the noise that is asked for."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

RAYS = 1600
FAR_M = 12.0


def scan_of(
    centres: Floats, diameters: Floats, *, noise: float = 0.0, seed: int = 1, rays: int = RAYS
) -> tuple[Floats, Floats]:
    """Angles and distances (N,) of one turn to the right about the origin; 0 where no trunk is met within range."""
    angles = -np.arange(rays, dtype=np.float64) * (2.0 * np.pi / rays)
    way = np.column_stack((np.cos(angles), np.sin(angles)))
    along = way @ np.asarray(centres, dtype=np.float64).reshape(-1, 2).T
    aside2 = np.sum(np.asarray(centres).reshape(-1, 2) ** 2, axis=1) - along**2
    radii2 = (np.asarray(diameters, dtype=np.float64) / 2.0) ** 2
    met = (along > 0.0) & (aside2 < radii2)
    reach = np.where(met, along - np.sqrt(np.maximum(radii2 - aside2, 0.0)), np.inf).min(axis=1, initial=np.inf)
    noisy = reach + np.random.default_rng(seed).normal(0.0, noise, rays) if noise else reach
    return angles, np.where(reach <= FAR_M, noisy, 0.0)
