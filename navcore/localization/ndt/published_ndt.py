"""NDT as published (Magnusson 2009; PCL's and ndt_omp's choices where it leaves any): one scale, Newton's method."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from navcore.errors import NotFiniteError
from navcore.geometry.se3 import SE3
from navcore.localization.ndt.match_kernels import Floats, turned
from navcore.localization.ndt.published_kernels import newton_equations
from navcore.localization.ndt.registration import Registration
from navcore.maps.ndt.cell_grid import CellGrid, CellParams
from navcore.maps.ndt.ndt_map import NdtMap


@dataclass(frozen=True, slots=True, kw_only=True)
class PublishedNdtParams:
    """Parameters of `PublishedNdt`.

    Attributes:
        size: edge of a cell, m; one of the map's (1 m: PCL's default, ndt_omp's for outdoor scans).
        outliers: ratio of points that are in no Gaussian, 0 to 1 (0.55: PCL).
        longest: step, m or rad, above 0 (0.1: PCL). enough: it is at rest when a step is shorter (0.001: with PCL's
            own 0.01 it stops before it is there).
        steps: at most, at least 1 (35: PCL).
        least_points: a scan has, at least 6.
        cells: how points become a Gaussian (as Magnusson has it).
    """

    size: float = 1.0
    outliers: float = 0.55
    longest: float = 0.1
    enough: float = 0.001
    steps: int = 35
    least_points: int = 100
    cells: CellParams = field(default_factory=lambda: CellParams(flattest=0.01, uniform=0.0))

    @property
    def d2(self) -> float:
        """Of equation 6.8: the Gaussian that stands for a mixture with uniform outliers."""
        c1, c2 = 10.0 * (1.0 - self.outliers), self.outliers / self.size**3
        d3 = -math.log(c2)
        d1 = -math.log(c1 + c2) - d3
        return -2.0 * math.log((-math.log(c1 * math.exp(-0.5) + c2) - d3) / d1)


class PublishedNdt:
    """Lays scans onto a map. Raises NdtMapError where the map has no cells of that size."""

    def __init__(self, ndt_map: NdtMap, params: PublishedNdtParams = PublishedNdtParams()) -> None:
        grid = ndt_map.grid(params.size)
        self._params = params
        self._grid = CellGrid.of(grid.size, grid.keys, grid.sums, params.cells)

    def match(self, points: Floats, guess: SE3) -> Registration:
        """Pose of a scan's points (N, 3), m, from a guess of it. Raises NotFiniteError."""
        points = np.ascontiguousarray(points, dtype=np.float64)
        if not (np.isfinite(points).all() and np.isfinite(guess.t).all() and np.isfinite(guess.R).all()):
            raise NotFiniteError("A point or the guess of its place is NaN or infinite; drop such points.")
        if len(points) < self._params.least_points:
            return _unknown(guess, f"The scan has {len(points)} points, {self._params.least_points} are needed.")
        return self._descended(points, guess)

    def _descended(self, points: Floats, guess: SE3) -> Registration:
        p, H, g = self._params, np.empty((6, 6)), np.empty(6)
        R, t, moved, count, weights, met = np.ascontiguousarray(guess.R), guess.t.copy(), math.inf, 0, 0.0, 0
        while count < p.steps and moved >= p.enough:
            weights, met = newton_equations(points, R, t, self._grid.cells(), p.d2, H, g)
            step = self._step(H, g)
            if not met or step is None:
                return _unknown(guess, "The score has no curvature here: the scan lies where the map has nothing.")
            R, t, moved, count = turned(R, step), t + step[:3], float(np.linalg.norm(step)), count + 1
        rested = moved < p.enough
        return Registration(
            T_target_source=SE3(R, t), covariance=_covariance(H, p.d2), score=weights / len(points),
            overlap=met / len(points), iterations=count,
            reason=None if rested else f"The match did not come to rest within {p.steps} steps.",
        )  # fmt: skip

    def _step(self, H: Floats, g: Floats) -> Floats | None:
        """Newton's step, turned about where it would climb, and no longer than `longest`."""
        step = np.linalg.lstsq(H, -g, rcond=None)[0]
        length = float(np.linalg.norm(step))
        if not math.isfinite(length) or length == 0.0:
            return None
        if step @ g > 0.0:
            step = -step
        return np.asarray(step * min(1.0, self._params.longest / length))


def _covariance(H: Floats, d2: float) -> Floats:
    """Inverse of the Hessian as published users take it; where it is not positive, as wide as nothing known."""
    w, V = np.linalg.eigh(d2 * H)
    return np.asarray(V @ np.diag(1.0 / np.maximum(w, 1.0)) @ V.T)


def _unknown(guess: SE3, reason: str) -> Registration:
    return Registration(
        T_target_source=guess, covariance=np.eye(6), score=0.0, overlap=0.0, iterations=0, reason=reason
    )
