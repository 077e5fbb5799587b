"""Residuals of all terms of a kind at given poses, and how they change with the poses' steps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.mapping.pose_graph.poses import Poses
from navcore.mapping.pose_graph.rotations import hat, left_inverse, log
from navcore.mapping.pose_graph.terms import LevelTerm, PositionTerm, RelativeTerm

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, eq=False)
class Linear:
    """M terms that hang on k nodes each, by r residuals.

    Attributes:
        nodes: (M, k). e: (M, r) residuals. J: (M, r, 6 k) by the nodes' steps. W: (M, r, r) information.
        share: (M,) of its weight that a term has in the sum, whatever a kernel leaves of it.
    """

    nodes: Ints
    e: Floats
    J: Floats
    W: Floats
    share: Floats | float = 1.0

    def chi2(self) -> Floats:
        """e^T W e (M,)."""
        return np.asarray(np.einsum("mi,mij,mj->m", self.e, self.W, self.e))


class RelativeTerms:
    """e = (R_i^T (t_j - t_i) - t, log(R_i^T R_j R^T)), along the axes of i."""

    def __init__(self, terms: Sequence[RelativeTerm]) -> None:
        self._nodes = np.array([(m.i, m.j) for m in terms], dtype=np.int64).reshape(-1, 2)
        self._R = np.array([m.T_i_j.R for m in terms]).reshape(-1, 3, 3)
        self._t = np.array([m.T_i_j.t for m in terms]).reshape(-1, 3)
        self._W = np.array([m.information for m in terms]).reshape(-1, 6, 6)

    def __len__(self) -> int:
        return len(self._nodes)

    def at(self, poses: Poses) -> Linear:
        """Their residuals and Jacobians."""
        i, j = self._nodes.T
        back = poses.R[i].transpose(0, 2, 1)
        away = poses.t[j] - poses.t[i]
        turn = log(back @ poses.R[j] @ self._R.transpose(0, 2, 1))
        e = np.concatenate((_times(back, away) - self._t, turn), axis=1)
        J = np.zeros((len(i), 6, 12))
        J[:, :3, 0:3], J[:, :3, 6:9] = -back, back
        J[:, :3, 3:6] = back @ hat(away)
        J[:, 3:, 9:12] = left_inverse(turn) @ back
        J[:, 3:, 3:6] = -J[:, 3:, 9:12]
        return Linear(self._nodes, e, J, self._W)


class PositionTerms:
    """e = t_i + R_i antenna - place, along the map's axes."""

    def __init__(self, terms: Sequence[PositionTerm]) -> None:
        self._nodes = np.array([(m.i,) for m in terms], dtype=np.int64).reshape(-1, 1)
        self._antenna = np.array([m.antenna for m in terms]).reshape(-1, 3)
        self._place = np.array([m.place for m in terms]).reshape(-1, 3)
        self._W = np.array([m.information for m in terms]).reshape(-1, 3, 3)
        self._share = np.array([m.share for m in terms])

    def __len__(self) -> int:
        return len(self._nodes)

    def at(self, poses: Poses) -> Linear:
        """Their residuals and Jacobians."""
        i = self._nodes[:, 0]
        arm = _times(poses.R[i], self._antenna)
        J = np.zeros((len(i), 3, 6))
        J[:, :, :3], J[:, :, 3:] = np.eye(3), -hat(arm)
        return Linear(self._nodes, poses.t[i] + arm - self._place, J, self._W, self._share)


class LevelTerms:
    """e = what leans of R_i up, along the map's x and y."""

    def __init__(self, terms: Sequence[LevelTerm]) -> None:
        self._nodes = np.array([(m.i,) for m in terms], dtype=np.int64).reshape(-1, 1)
        self._up = np.array([m.up for m in terms]).reshape(-1, 3)
        self._W = np.array([np.eye(2) / m.std**2 for m in terms]).reshape(-1, 2, 2)

    def __len__(self) -> int:
        return len(self._nodes)

    def at(self, poses: Poses) -> Linear:
        """Their residuals and Jacobians."""
        up = _times(poses.R[self._nodes[:, 0]], self._up)
        J = np.zeros((len(up), 2, 6))
        J[:, :, 3:] = -hat(up)[:, :2]
        return Linear(self._nodes, up[:, :2], J, self._W)


def _times(R: Floats, v: Floats) -> Floats:
    return np.asarray(np.einsum("mij,mj->mi", R, v))
