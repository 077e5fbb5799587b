"""Compiled arithmetic of `bending_row`: a line by weighted least squares, with and without each of many bends."""

from __future__ import annotations

import numpy as np
from numba import njit
from numpy.typing import NDArray

Floats = NDArray[np.float64]


@njit(cache=True)
def averaged(
    basis: Floats, off: Floats, weights: Floats, bends: Floats, asked: Floats, asked_bends: Floats, prior: Floats,
    chances: Floats,
) -> tuple[Floats, Floats]:  # fmt: skip
    """What is asked for, (Q,), and its covariance, (Q, Q), over all scatters and bends by how likely each is.

    A place `off` (N,) is `basis` (N, P) times the unknowns, or that and an unknown size times one of the `bends`
    (K, N); `weights` (S, N) are 1 / variance for each scatter, `prior` (P + 1,) the information on the unknowns and
    the size, `chances` (K + 1,) the logarithms of what no bend and each of them is worth beforehand. Asked for is
    `asked` (Q, P) times the unknowns, with `asked_bends` (K, Q) times the size. Each bend is added to the fit without
    one by the inverse of a matrix that grows by one row.
    """
    count, many, n = len(chances), len(weights) * len(chances), len(asked)
    evidence, means, sides = np.empty(many), np.empty((many, n)), np.zeros((many, n))
    straight = np.empty((len(weights), n, n))
    for s in range(len(weights)):
        w, first, last = weights[s], s * count, (s + 1) * count
        weighted = basis * w.reshape(-1, 1)
        information = weighted.T @ basis + np.diag(prior[:-1])
        inverse = np.linalg.inv(information)
        rest = weighted.T @ off
        found = inverse @ rest
        told = np.sum(np.log(w)) + np.sum(np.log(prior[:-1])) - np.log(np.linalg.det(information))
        plain = 0.5 * (told - np.sum(w * off * off) + rest @ found)
        to_asked = inverse @ asked.T
        straight[s] = asked @ to_asked
        bent = bends * w
        along = bent @ basis
        sure = prior[-1] + np.sum(bent * bends, axis=1) - np.sum((along @ inverse) * along, axis=1)
        size = (bent @ off - along @ found) / sure
        side = asked_bends - along @ to_asked
        evidence[first], means[first:last] = plain, asked @ found
        evidence[first + 1 : last] = plain + 0.5 * (size * size * sure - np.log(sure / prior[-1]))
        evidence[first:last] += chances
        means[first + 1 : last] += size.reshape(-1, 1) * side
        sides[first + 1 : last] = side / np.sqrt(sure).reshape(-1, 1)
    share = np.exp(evidence - np.max(evidence))
    share /= np.sum(share)
    mean = share @ means
    apart, counted = means - mean, share.reshape(-1, 1)
    covariance = sides.T @ (counted * sides) + apart.T @ (counted * apart)
    for s in range(len(weights)):
        covariance += np.sum(share[s * count : (s + 1) * count]) * straight[s]
    return mean, covariance
