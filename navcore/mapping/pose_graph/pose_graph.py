"""The graph: poses, terms between them, and the poses that fit them best."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from navcore.errors import ContractError, NotFiniteError
from navcore.geometry.se3 import SE3
from navcore.mapping.pose_graph.levenberg import Kind, LevenbergParams, fitted
from navcore.mapping.pose_graph.linear import LevelTerms, PositionTerms, RelativeTerms
from navcore.mapping.pose_graph.poses import Poses
from navcore.mapping.pose_graph.terms import LevelTerm, PositionTerm, RelativeTerm, Term

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class PoseGraphParams:
    """Parameters of `PoseGraph`.

    Attributes:
        loop_chi2, position_chi2: squared Mahalanobis distance at which a loop or a position has lost three quarters
            of its weight (Geman-McClure), above 0. 16.8 is passed by 99 % of honest loops (6 degrees of freedom),
            11.3 by as many positions (3).
        levenberg: how the fit is sought.
    """

    loop_chi2: float = 16.8
    position_chi2: float = 11.3
    levenberg: LevenbergParams = field(default_factory=LevenbergParams)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Solution:
    """Poses that fit.

    Attributes:
        poses: `T_map_base` of each node.
        loop_weights, position_weights: what the robust kernel left of each loop's and position's weight, 0 to 1, in
            the order in which they were added. position_errors: (P, 3) m, along the map's axes.
        converged: False where the most steps were not enough.
    """

    poses: Poses
    loop_weights: Floats
    position_weights: Floats
    position_errors: Floats
    converged: bool


class PoseGraph:
    """Without positions the first pose stays where it is; else positions hold the whole."""

    def __init__(self, start: Sequence[SE3], params: PoseGraphParams = PoseGraphParams()) -> None:
        """`start`: a first guess of each node, `T_map_base`. Raises NotFiniteError."""
        self._start, self._params = Poses.of(start), params
        self._steps: list[RelativeTerm] = []
        self._loops: list[RelativeTerm] = []
        self._positions: list[PositionTerm] = []
        self._levels: list[LevelTerm] = []

    def add(self, term: Term) -> None:
        """Raises NotFiniteError for a term that is no number, ContractError for a node that is not there."""
        _check(term, len(self._start))
        if isinstance(term, PositionTerm):
            self._positions.append(term)
        elif isinstance(term, LevelTerm):
            self._levels.append(term)
        else:
            (self._loops if term.loop else self._steps).append(term)

    def solve(self) -> Solution:
        """The poses of the least robust sum of squares."""
        p, inf = self._params, np.inf
        kinds = [
            Kind(RelativeTerms(self._steps), inf),
            Kind(LevelTerms(self._levels), inf),
            Kind(RelativeTerms(self._loops), p.loop_chi2),
            Kind(PositionTerms(self._positions), p.position_chi2),
        ]
        poses, converged = fitted(self._start, kinds, held=not self._positions, params=p.levenberg)
        loops, positions = (kind.terms.at(poses) for kind in kinds[2:])
        return Solution(
            poses=poses, loop_weights=kinds[2].weights(loops.chi2()), converged=converged,
            position_weights=kinds[3].weights(positions.chi2()), position_errors=positions.e,
        )  # fmt: skip


def _check(term: Term, nodes: int) -> None:
    if not all(np.isfinite(a).all() for a in _numbers(term)):
        raise NotFiniteError("A measurement of the pose graph is NaN or infinite; leave it out.")
    own = (term.i, term.j) if isinstance(term, RelativeTerm) else (term.i,)
    if not all(0 <= i < nodes for i in own):
        raise ContractError(f"A term hangs on node {max(own)}, but the graph has {nodes}.")


def _numbers(term: Term) -> tuple[Floats, ...]:
    if isinstance(term, RelativeTerm):
        return term.T_i_j.R, term.T_i_j.t, term.information
    if isinstance(term, PositionTerm):
        return term.antenna, term.place, term.information
    return term.up, np.array(term.std)
