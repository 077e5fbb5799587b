"""How the camera leans to the side, from how fast plants on its left and on its right come nearer.

A camera whose left side is up by `phi` sees a foot `y` to the left 1 - phi y / h times as far away as it stands, `h`
its height: while the robot drives, plants on the left seem to come at another speed than those on the right. Slip of
the wheels and a wrong height are the same for both sides, and so is the pitch of each picture; all are solved for.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.perception.plant_sightings import Sightings

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class LeanFitParams:
    """Parameters of `fit_lean`.

    Attributes:
        foot_px: 1-sigma of a foot's image row at 640 px width.
        pitch_deg: 1-sigma of what each picture's own pitch is wrong by.
        stretch: 1-sigma of the share by which wheels and the camera's height are wrong.
        passed: a plant counts if the robot drove so far while it was in sight, m.
        plants: so many are needed on each side.
        soft: residuals of more than so many 1-sigma weigh less.
        rounds: of reweighting.
        floor_deg: 1-sigma that no number of pictures takes away.
    """

    foot_px: float = 2.0
    pitch_deg: float = 0.5
    stretch: float = 0.03
    passed: float = 0.8
    plants: int = 2
    soft: float = 1.5
    rounds: int = 4
    floor_deg: float = 0.4


@dataclass(frozen=True, slots=True)
class Lean:
    """Roll of the driving frame beyond what was told, rad (left side up), and its 1-sigma."""

    roll: float
    std: float


def fit_lean(seen: Sightings, height: float, focal_px: float, params: LeanFitParams) -> Lean | None:
    """The camera's lean over the pictures of `seen`, None if too few plants were passed.

    `height` above the ground, m; `focal_px` at 640 px width.
    """
    seen = passed(seen, params)
    lefts, rights = np.unique(seen.plant[seen.left]), np.unique(seen.plant[~seen.left])
    if min(len(lefts), len(rights)) < params.plants:
        return None
    A, b = equations(seen, height, focal_px, params)
    z, information = solved(A, b, len(seen.x), params)
    k = A.shape[1] - 2
    std = math.sqrt(float(np.linalg.inv(information)[k, k]))
    return Lean(float(z[k]), math.hypot(std, math.radians(params.floor_deg)))


def passed(seen: Sightings, params: LeanFitParams) -> Sightings:
    """Only the plants that the robot came nearer to."""
    least = np.full(int(seen.plant.max(initial=-1)) + 1, np.inf)
    most = -least
    np.minimum.at(least, seen.plant, seen.x)
    np.maximum.at(most, seen.plant, seen.x)
    keep = (most - least > params.passed)[seen.plant]
    return Sightings(
        picture=seen.picture[keep], plant=seen.plant[keep], x=seen.x[keep], y=seen.y[keep], along=seen.along[keep],
        left=seen.left[keep],
    )  # fmt: skip


def equations(seen: Sightings, height: float, focal_px: float, params: LeanFitParams) -> tuple[Floats, Floats]:
    """Weighted rows (N + F + 1, P + F + 2) and right side, for places of P plants, pitches of F pictures, lean and
    stretch.
    """
    plants, plant = np.unique(seen.plant, return_inverse=True)
    pictures, picture = np.unique(seen.picture, return_inverse=True)
    n, P, F = len(seen.x), len(plants), len(pictures)
    per_pitch = (seen.x**2 + height**2) / height
    sigma = per_pitch / focal_px * params.foot_px + 0.01
    A, b, row = np.zeros((n + F + 1, P + F + 2)), np.zeros(n + F + 1), np.arange(n)
    A[row, plant], A[row, P + picture] = 1.0, per_pitch
    A[row, P + F], A[row, P + F + 1] = -seen.x * seen.y / height, seen.x
    A[:n] /= sigma[:, None]
    b[:n] = seen.along / sigma
    A[n + np.arange(F), P + np.arange(F)] = 1.0 / math.radians(params.pitch_deg)
    A[-1, -1] = 1.0 / params.stretch
    return A, b


def solved(A: Floats, b: Floats, n: int, params: LeanFitParams) -> tuple[Floats, Floats]:
    """Solution of A z = b and its information; the first `n` equations are reweighted by their residuals."""
    weight: Floats = np.ones(len(b))
    z: Floats = np.zeros(A.shape[1])
    information: Floats = np.eye(A.shape[1])
    for _ in range(params.rounds):
        weighted = A * weight[:, None]
        information = weighted.T @ weighted
        z = np.asarray(np.linalg.solve(information, weighted.T @ (b * weight)), dtype=np.float64)
        residual = A[:n] @ z - b[:n]
        weight[:n] = 1.0 / np.sqrt(1.0 + (residual / params.soft) ** 2)
    return z, information
