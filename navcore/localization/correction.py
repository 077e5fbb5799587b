"""Correction of a belief by one measurement, behind a gate."""

from __future__ import annotations

import numpy as np

from navcore.geometry.angles import wrap
from navcore.localization.belief import STATES, YAW, Belief, Floats


def mahalanobis(b: Belief, H: Floats, residual: Floats, R: Floats) -> float:
    """Squared distance of a residual (k,) from what the belief and the noise R (k, k) let expect; H is (k, 8)."""
    S = H @ b.cov @ H.T + R
    return float(residual @ np.linalg.solve(S, residual))


def correct(b: Belief, H: Floats, residual: Floats, R: Floats) -> None:
    """Kalman correction in place, covariance in Joseph's form, which stays symmetric and positive."""
    S = H @ b.cov @ H.T + R
    K = np.linalg.solve(S, H @ b.cov).T
    b.mean += K @ residual
    b.mean[YAW] = wrap(float(b.mean[YAW]))
    A = np.eye(STATES) - K @ H
    b.cov = A @ b.cov @ A.T + K @ R @ K.T
