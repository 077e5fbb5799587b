"""Distances between surveyed posts as a map has them: paper C's check of its map."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.se3 import SE3
from navcore.sim.block_survey import SurveyedDistance

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Distances:
    """Measured against surveyed.

    Attributes:
        errors: (N,) map less survey, m. true: (N,) m. along: (N,) along a line of posts, else across.
        lost: distances of which a post was not found.
    """

    errors: Floats
    true: Floats
    along: NDArray[np.bool_]
    lost: int

    @staticmethod
    def joined(parts: Sequence[Distances]) -> Distances:
        """Of several maps."""
        return Distances(
            errors=np.concatenate([p.errors for p in parts]), true=np.concatenate([p.true for p in parts]),
            along=np.concatenate([p.along for p in parts]), lost=sum(p.lost for p in parts),
        )  # fmt: skip

    def where(self, kept: NDArray[np.bool_]) -> Distances:
        """Some of them; `lost` is all of them."""
        return Distances(errors=self.errors[kept], true=self.true[kept], along=self.along[kept], lost=self.lost)

    @property
    def mean(self) -> float:
        """Mean of the errors' size, m."""
        return float(np.abs(self.errors).mean())

    @property
    def worst(self) -> float:
        """Largest size of an error, m."""
        return float(np.abs(self.errors).max())

    @property
    def variation(self) -> float:
        """Coefficient of variation: standard deviation of measured over true distances, by their mean; a share."""
        ratio = (self.true + self.errors) / self.true
        return float(ratio.std() / ratio.mean())


def distances(mapped: Floats, surveyed: Sequence[SurveyedDistance]) -> Distances:
    """`mapped`: (P, 2) m, NaN for a post that was not found."""
    first, second = (np.array([getattr(d, name) for d in surveyed], dtype=np.int64) for name in ("first", "second"))
    true, along = np.array([d.distance for d in surveyed]), np.array([d.along for d in surveyed], dtype=np.bool_)
    errors = np.hypot(*(mapped[first] - mapped[second]).T) - true
    found = np.isfinite(errors)
    return Distances(errors=errors[found], true=true[found], along=along[found], lost=int((~found).sum()))


def laid_on(poses: Sequence[SE3], truth: Sequence[SE3]) -> list[SE3]:
    """Poses moved as a whole, without a stretch, so that they lie nearest to the truth (Kabsch)."""
    own, true = (np.array([T.t for T in some]) for some in (poses, truth))
    U, _, Vt = np.linalg.svd((own - own.mean(axis=0)).T @ (true - true.mean(axis=0)))
    flip = np.diag((1.0, 1.0, np.sign(np.linalg.det(Vt.T @ U.T))))
    R = Vt.T @ flip @ U.T
    T_true_own = SE3(R, true.mean(axis=0) - R @ own.mean(axis=0))
    return [T_true_own @ T for T in poses]
