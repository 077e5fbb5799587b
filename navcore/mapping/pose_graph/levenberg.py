"""Levenberg and Marquardt's steps on a sparse graph, with robust kernels that harden by degrees.

Kernel: Geman and McClure's, rho = c x / (c + x) of x = chi^2. It is not convex: a loop that corrects a long drift is
far off at first and would be taken for a lie. So c begins as large as the worst chi^2 and is halved until it is the
wanted one (graduated non-convexity, Yang et al. 2020).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csc_array, diags_array
from scipy.sparse.linalg import splu

from navcore.mapping.pose_graph.linear import Linear
from navcore.mapping.pose_graph.poses import Poses

Floats = NDArray[np.float64]


class Terms(Protocol):
    """All terms of a kind."""

    def __len__(self) -> int: ...
    def at(self, poses: Poses) -> Linear: ...


@dataclass(frozen=True, slots=True, eq=False)
class Kind:
    """Terms and the chi^2 at which their kernel bends; infinite for terms that are not doubted."""

    terms: Terms
    bend: float

    def weights(self, chi2: Floats, softer: float = 1.0) -> Floats:
        """rho' (M,), 0 to 1."""
        c = self.bend * softer
        return np.ones(len(chi2)) if np.isinf(c) else (c / (c + chi2)) ** 2

    def cost(self, linear: Linear, softer: float) -> float:
        """Sum of rho."""
        c, chi2 = self.bend * softer, linear.chi2()
        return float((linear.share * (chi2 if np.isinf(c) else c * chi2 / (c + chi2))).sum())


@dataclass(frozen=True, slots=True, kw_only=True)
class LevenbergParams:
    """Parameters of `fitted`.

    Attributes:
        most_steps: for each hardness of the kernels, 1 to 1000; each is left at 1 % of change but the last.
        enough: relative decrease of the cost that ends it, 1e-12 to 1e-3.
        damping: first share of the diagonal that is added to it, 1e-12 to 1.
    """

    most_steps: int = 50
    enough: float = 1e-7
    damping: float = 1e-6


def fitted(start: Poses, kinds: Sequence[Kind], *, held: bool, params: LevenbergParams) -> tuple[Poses, bool]:
    """Poses of the least cost, and whether they were reached; `held`: the first pose does not move."""
    kinds = [kind for kind in kinds if len(kind.terms)]
    poses, softer, converged = start, _softest(start, kinds), not kinds
    while kinds:
        enough = params.enough if softer == 1.0 else 1e-2
        poses, converged = _descended(poses, kinds, softer, held, enough, params)
        if softer == 1.0:
            break
        softer = max(softer / 2.0, 1.0)
    return poses, converged


def _softest(poses: Poses, kinds: Sequence[Kind]) -> float:
    """So much softer that the worst doubted term counts in full at first."""
    worst = [float(k.terms.at(poses).chi2().max()) / k.bend for k in kinds if np.isfinite(k.bend)]
    return max(1.0, 2.0 * max(worst, default=0.0))


def _descended(
    poses: Poses, kinds: Sequence[Kind], softer: float, held: bool, enough: float, params: LevenbergParams
) -> tuple[Poses, bool]:
    damping, (linears, cost) = params.damping, _at(poses, kinds, softer)
    for _ in range(params.most_steps):
        H, g = _normal_equations(linears, kinds, softer, len(poses))
        trial = poses.moved(_step(H, g, damping, held))
        trial_linears, trial_cost = _at(trial, kinds, softer)
        if trial_cost > cost * (1.0 + 1e-12) + 1e-18:
            if damping > 1e6:
                return poses, True  # no step is small enough to gain: the bottom, as far as digits go
            damping *= 10.0
            continue
        gained, poses, linears = cost - trial_cost, trial, trial_linears
        cost, damping = trial_cost, max(damping / 10.0, 1e-12)
        if gained <= enough * cost + 1e-15:
            return poses, True
    return poses, False


def _at(poses: Poses, kinds: Sequence[Kind], softer: float) -> tuple[list[Linear], float]:
    linears = [kind.terms.at(poses) for kind in kinds]
    return linears, sum(kind.cost(m, softer) for kind, m in zip(kinds, linears, strict=True))


def _normal_equations(
    linears: Sequence[Linear], kinds: Sequence[Kind], softer: float, nodes: int
) -> tuple[csc_array, Floats]:
    """H (6 N, 6 N) and g (6 N,)."""
    g = np.zeros(6 * nodes)
    rows, columns, values = [], [], []
    for kind, m in zip(kinds, linears, strict=True):
        WJ = (m.share * kind.weights(m.chi2(), softer))[:, None, None] * (m.W @ m.J)
        at = (6 * m.nodes[:, :, None] + np.arange(6)).reshape(len(m.nodes), -1)
        np.add.at(g, at, np.einsum("mri,mr->mi", WJ, m.e))
        blocks = m.J.transpose(0, 2, 1) @ WJ
        rows.append(np.broadcast_to(at[:, :, None], blocks.shape).ravel())
        columns.append(np.broadcast_to(at[:, None, :], blocks.shape).ravel())
        values.append(blocks.ravel())
    where = (np.concatenate(rows), np.concatenate(columns))
    return csc_array(coo_array((np.concatenate(values), where), shape=(6 * nodes, 6 * nodes))), g


def _step(H: csc_array, g: Floats, damping: float, held: bool) -> Floats:
    """Steps (N, 6); a node that nothing holds stays."""
    first = 6 if held else 0
    diagonal = H.diagonal()
    damped = csc_array(H + diags_array(damping * diagonal + 1e-9))[first:, first:]
    factors = splu(
        csc_array(damped), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
    )
    step = np.zeros(len(g))
    step[first:] = -factors.solve(g[first:])
    return step.reshape(-1, 6)
