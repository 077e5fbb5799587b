"""Rotations by the thousand: arrays (M, 3, 3) and their rotation vectors (M, 3), rad."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
_TINY = 1e-6


def hat(v: Floats) -> Floats:
    """[v]x of vectors (M, 3): (M, 3, 3)."""
    K = np.zeros((*v.shape, 3))
    K[:, 2, 1], K[:, 0, 2], K[:, 1, 0] = v[:, 0], v[:, 1], v[:, 2]
    return np.asarray(K - K.transpose(0, 2, 1))


def exp(v: Floats) -> Floats:
    """Rodrigues' formula."""
    angle = np.linalg.norm(v, axis=1)[:, None, None]
    safe = np.maximum(angle, _TINY)
    K = hat(v)
    a = np.where(angle > _TINY, np.sin(safe) / safe, 1.0)
    b = np.where(angle > _TINY, (1.0 - np.cos(safe)) / safe**2, 0.5)
    return np.asarray(np.eye(3) + a * K + b * (K @ K))


def log(R: Floats) -> Floats:
    """Rotation vectors, no longer than pi; near pi by the largest column of R + I."""
    axis = np.stack((R[:, 2, 1] - R[:, 1, 2], R[:, 0, 2] - R[:, 2, 0], R[:, 1, 0] - R[:, 0, 1]), axis=1)
    sine = np.linalg.norm(axis, axis=1)
    angle = np.arctan2(sine, np.trace(R, axis1=1, axis2=2) - 1.0)
    scale = np.where(sine > _TINY, angle / np.maximum(sine, _TINY), 0.5)
    v = scale[:, None] * axis
    half_turn = (angle > 3.0) & (sine < 1e-3)
    v[half_turn] = angle[half_turn, None] * _half_turn_axes(R[half_turn], axis[half_turn])
    return np.asarray(v)


def _half_turn_axes(R: Floats, axis: Floats) -> Floats:
    """Unit axes of rotations by almost pi, their signs as in `axis`."""
    columns = R + np.eye(3)
    best = np.linalg.norm(columns, axis=1).argmax(axis=1)
    u = columns[np.arange(len(R)), :, best]
    u = u / np.maximum(np.linalg.norm(u, axis=1), _TINY)[:, None]
    return np.asarray(np.where((u * axis).sum(axis=1)[:, None] < 0.0, -u, u))


def left_inverse(v: Floats) -> Floats:
    """Inverse of the left Jacobian: log(exp(d) exp(v)) is v + left_inverse(v) d for small d."""
    angle = np.linalg.norm(v, axis=1)[:, None, None]
    safe = np.maximum(angle, 1e-3)
    K = hat(v)
    c = np.where(angle > 1e-3, 1.0 / safe**2 - 1.0 / (2.0 * safe * np.tan(safe / 2.0)), 1.0 / 12.0)
    return np.asarray(np.eye(3) - 0.5 * K + c * (K @ K))
