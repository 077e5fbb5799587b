"""The unknowns of a pose graph."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import NotFiniteError
from navcore.geometry.se3 import SE3
from navcore.mapping.pose_graph.rotations import exp

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Poses:
    """`T_map_base` of N nodes.

    Attributes:
        R: (N, 3, 3). t: (N, 3), m.
    """

    R: Floats
    t: Floats

    @staticmethod
    def of(poses: Sequence[SE3]) -> Poses:
        """Raises NotFiniteError for a pose that is no number."""
        R = np.array([T.R for T in poses]).reshape(-1, 3, 3)
        t = np.array([T.t for T in poses]).reshape(-1, 3)
        if not (np.isfinite(R).all() and np.isfinite(t).all()):
            raise NotFiniteError("A pose of the graph is NaN or infinite; leave such poses out before it is solved.")
        return Poses(R, t)

    def __len__(self) -> int:
        return len(self.t)

    def __getitem__(self, i: int) -> SE3:
        return SE3(self.R[i], self.t[i])

    def moved(self, steps: Floats) -> Poses:
        """Each by its step (N, 6): translation, m, and rotation vector, rad, both along the map's axes."""
        return Poses(exp(steps[:, 3:]) @ self.R, self.t + steps[:, :3])
