"""Correction of a belief by one measurement of one or two numbers, behind a gate."""

from __future__ import annotations

import numpy as np

from navcore.geometry.angles import wrap
from navcore.localization.belief import STATES, YAW, Belief, Floats

IDENTITY = np.eye(STATES)


class Innovation:
    """What a measurement says beyond what the belief foretold.

    Args:
        H: Jacobian of the measurement, shape (k, 7), k is 1 to 3.
        residual: measured minus foretold, shape (k,).
        R: covariance of the measurement's noise, shape (k, k).
    """

    __slots__ = ("_H", "_PHt", "_R", "_S_inverse", "_belief", "_residual")

    def __init__(self, b: Belief, H: Floats, residual: Floats, R: Floats) -> None:
        self._belief, self._H, self._residual, self._R = b, H, residual, R
        self._PHt = b.cov.dot(H.T)
        self._S_inverse = inverse(H.dot(self._PHt) + R)

    def distance(self) -> float:
        """Squared Mahalanobis distance: chi-square with k degrees of freedom if all is as believed."""
        return float(self._residual.dot(self._S_inverse).dot(self._residual))

    def apply(self) -> None:
        """Kalman correction in place, covariance in Joseph's form, which stays symmetric and positive."""
        b = self._belief
        K = self._PHt.dot(self._S_inverse)
        b.mean += K.dot(self._residual)
        b.mean[YAW] = wrap(float(b.mean[YAW]))
        A = IDENTITY - K.dot(self._H)
        b.cov = A.dot(b.cov).dot(A.T) + K.dot(self._R).dot(K.T)


def inverse(S: Floats) -> Floats:
    """Inverse of a positive definite matrix; for (1, 1) and (2, 2) ten times faster than LAPACK."""
    if len(S) > 2:
        return np.asarray(np.linalg.inv(S))
    if len(S) == 1:
        reciprocal: Floats = np.divide(1.0, S)
        return reciprocal
    (a, b), (c, d) = S.tolist()
    turned: Floats = np.array(((d, -b), (-c, a))) / (a * d - b * c)
    return turned
