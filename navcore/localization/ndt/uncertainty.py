"""How sure a match is: from the curvature of its score, and where it has none."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from navcore.localization.ndt.registration import Floats, WeakDirection


@dataclass(frozen=True, slots=True, kw_only=True)
class UncertaintyParams:
    """Parameters of `covariance_of`.

    Attributes:
        points_as_one: so many points say as much as one independent one, at least 1: neighbours meet the same leaf,
            and the map has it a little elsewhere (measured on simulated rows: errors over what the curvature tells).
        floor, floor_turn: 1-sigma is no less, m and rad: the map's own errors are the same at every look.
        weak: 1-sigma from which a direction is called weak, m.
    """

    points_as_one: float = 20.0
    floor: float = 0.003
    floor_turn: float = 1e-4
    weak: float = 0.1


def covariance_of(H: Floats, hold: Floats, params: UncertaintyParams) -> Floats:
    """(6, 6) from the normal matrix `H` (6, 6) and the information (6,) that holds the guess; always finite."""
    inverse = np.linalg.inv(H / params.points_as_one + np.diag(hold))
    floor = np.repeat((params.floor**2, params.floor_turn**2), 3)
    return np.asarray((inverse + inverse.T) / 2.0 + np.diag(floor))


def held(covariance: Floats, weak: tuple[WeakDirection, ...], std: float) -> Floats:
    """The covariance where the pose was put back onto a guess of 1-sigma `std`, m, along the weak directions."""
    A, back = np.eye(6), np.zeros((6, 6))
    for w in weak:
        along = np.outer(w.direction, w.direction)
        A[:3, :3] -= along
        back[:3, :3] += std**2 * along
    return np.asarray(A @ covariance @ A.T + back)


def weak_directions(covariance: Floats, params: UncertaintyParams) -> tuple[WeakDirection, ...]:
    """Principal directions of the position's covariance that are longer than `params.weak`, the weakest first."""
    variances, directions = np.linalg.eigh(covariance[:3, :3])
    return tuple(
        WeakDirection(direction=_facing(directions[:, k]), std=float(variances[k] ** 0.5))
        for k in (2, 1, 0)
        if variances[k] > params.weak**2
    )


def _facing(direction: Floats) -> Floats:
    """Of the two, the one whose largest part is positive."""
    return np.asarray(direction * np.sign(direction[np.abs(direction).argmax()]))
