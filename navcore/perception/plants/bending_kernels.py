"""Compiled arithmetic of `bending_row`: a line by weighted least squares, with and without each of many bends."""

from __future__ import annotations

import math

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
        w, at = weights[s], s * count
        root, told = inverse_root(basis, w, prior[:-1])
        white, to_asked = basis @ root.T, asked @ root.T  # of unknowns that are sure to 1, each by itself
        found = (w * off) @ white
        straight[s] = to_asked @ to_asked.T
        plain = 0.5 * (told - np.sum(w * off * off) + np.sum(found * found))
        evidence[at], means[at] = plain + chances[0], to_asked @ found
        bent = bends * w
        along = bent @ white
        side = asked_bends - along @ to_asked.T
        for k in range(len(bends)):
            sure, told_size, at = prior[-1], 0.0, at + 1
            for i in range(len(off)):
                sure, told_size = sure + bent[k, i] * bends[k, i], told_size + bent[k, i] * off[i]
            for j in range(len(found)):
                sure, told_size = sure - along[k, j] * along[k, j], told_size - along[k, j] * found[j]
            size, std = told_size / sure, 1.0 / math.sqrt(sure)
            evidence[at] = plain + 0.5 * (size * size * sure - math.log(sure / prior[-1])) + chances[k + 1]
            for q in range(n):
                means[at, q], sides[at, q] = means[s * count, q] + size * side[k, q], side[k, q] * std
    share = np.exp(evidence - np.max(evidence))
    share /= np.sum(share)
    mean = share @ means
    apart, counted = means - mean, share.reshape(-1, 1)
    covariance = sides.T @ (counted * sides) + apart.T @ (counted * apart)
    for s in range(len(weights)):
        covariance += np.sum(share[s * count : (s + 1) * count]) * straight[s]
    return mean, covariance


@njit(cache=True)
def inverse_root(basis: Floats, weights: Floats, prior: Floats) -> tuple[Floats, float]:
    """(P, P) whose transpose times itself is the covariance of unknowns that places tell which are `basis` (N, P)
    times them, each with its weight (N,), beside the information `prior` (P,); and what weights, prior and covariance
    together add to twice the logarithm of how likely the places are.
    """
    lower = np.linalg.cholesky((basis * weights.reshape(-1, 1)).T @ basis + np.diag(prior))
    told = np.sum(np.log(weights)) + np.sum(np.log(prior)) - 2.0 * np.sum(np.log(np.diag(lower)))
    root = np.zeros_like(lower)
    for i in range(len(prior)):  # L times the root is 1
        root[i, i] = 1.0
        for j in range(i):
            root[i, : j + 1] -= lower[i, j] * root[j, : j + 1]
        root[i, : i + 1] /= lower[i, i]
    return root, told


@njit(cache=True)
def about(
    corridor: tuple[float, float, float], plants: Floats, next_sure: float, beside: float
) -> tuple[Floats, Floats, Floats, Floats]:
    """Of plants (M, 4), as in `ScanEvidence`, that stand on the lines of a corridor (offset, heading, width) or on
    the next ones: (N,) how far along they stand, m, on which line, by how much beside it to the left, m, and (N, 2)
    each one's variance, m^2, and how sure it is.

    The lines are +1 and -1, the row's on the left and on the right, and +3 and -3, the next ones.
    """
    offset, heading, width = corridor
    along, line, off = np.empty(len(plants)), np.empty(len(plants)), np.empty(len(plants))
    sure, k = np.empty((len(plants), 2)), 0
    c, s = math.cos(heading), math.sin(heading)
    for x, y, std, weight in plants:
        left = c * y - s * x
        side = math.copysign(1.0 if abs(left - offset) < width else 3.0, left - offset)
        aside = left - offset - 0.5 * side * width
        if abs(aside) <= beside and (abs(side) == 1.0 or weight >= next_sure):
            along[k], line[k], off[k], sure[k, 0], sure[k, 1] = c * x + s * y, side, aside, std * std, weight
            k += 1
    return along[:k], line[:k], off[:k], sure[:k]


@njit(cache=True)
def shared(along: Floats, line: Floats, sure: Floats, apart: float) -> Floats:
    """(N,) how much each counts, 0 to 1, that stands `along` (N,) its `line` (N,) and is as `sure` (N,) a plant.

    Plants of one line stand `apart` m from each other or more: of those nearer to each other one is the plant, and
    the others are its stake or weeds. Together they count once.
    """
    out = np.empty(len(along))
    for i in range(len(along)):
        told = 0.0
        for j in range(len(along)):
            if line[j] == line[i] and abs(along[j] - along[i]) < apart:
                told += sure[j]
        out[i] = sure[i] / max(told, 1.0)
    return out


@njit(cache=True)
def basis(x: Floats, side: Floats) -> Floats:
    """(N, 7) by what the middle's offset, turn and width, and offset and turn of the next line on the left and on the
    right, put a plant aside that stands `x` (N,) along the line `side` (N,) of `about`.
    """
    out = np.zeros((len(x), 7))
    for i in range(len(x)):
        out[i, 0], out[i, 1], out[i, 2] = 1.0, x[i], 0.5 * side[i]
        if abs(side[i]) > 1.0:
            first = 3 if side[i] > 0.0 else 5
            out[i, first], out[i, first + 1] = 1.0, x[i]
    return out


@njit(cache=True)
def bends(x: Floats, shifts: Floats, curve: float) -> Floats:
    """(K + 1, N) at places (N,) along the row: `shifts` (K, 2) by 1 m, each about its place and over its length, and
    an even curve, 1/m.
    """
    out = np.empty((len(shifts) + 1, len(x)))
    for i in range(len(x)):
        for k in range(len(shifts)):
            out[k, i] = min(max((x[i] - shifts[k, 0]) / shifts[k, 1], -0.5), 0.5)
        out[-1, i] = 0.5 * curve * x[i] * x[i]
    return out
