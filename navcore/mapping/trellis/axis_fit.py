"""The axis of an upright round thing from the rays that met it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

# A ray that meets a cylinder somewhere ends this share of the radius before its axis, on the mean of all such rays.
_MEAN_DEPTH = np.pi / 4.0


@dataclass(frozen=True, slots=True, kw_only=True)
class AxisFitParams:
    """Parameters of `fit_axis`.

    Attributes:
        range_std: 1-sigma of a distance, m (sensor sheets: 2 to 3 cm). across_std: 1-sigma of where across a ray the
            axis lies that it met, m: half a post's thickness.
        slope_std: 1-sigma of a post's lean, m per m.
        rounds: of reweighting. outlier: residual in sigmas beyond which a point weighs less.
        independent: points that err alike, from one view: so many times their number is as good as one.
        least_std: no axis is known better, m.
    """

    range_std: float = 0.025
    across_std: float = 0.03
    slope_std: float = 0.03
    rounds: int = 6
    outlier: float = 2.0
    independent: float = 30.0
    least_std: float = 0.005


@dataclass(frozen=True, slots=True, kw_only=True)
class UprightAxis:
    """An axis in `map`.

    Attributes:
        x, y: at the ground, m. slope_x, slope_y: m per m of height.
        radius: m; 0 where the rays are not known. std: 1-sigma of x and y, each, m.
    """

    x: float
    y: float
    slope_x: float
    slope_y: float
    radius: float
    std: float

    def at(self, height: float) -> tuple[float, float]:
        """Where it is so high above the ground."""
        return self.x + height * self.slope_x, self.y + height * self.slope_y


def fit_axis(points: Floats, origins: Floats | None, params: AxisFitParams = AxisFitParams()) -> UprightAxis:
    """From points (N, 3), N >= 3, whose z is the height above the ground, m, and where each was seen from (N, 3).

    Weighted least squares in foot, slopes and depth: across its ray a point lies about the axis, along it the depth
    of the surface before it; robust by Huber's weights. Without origins points lie about the axis in any
    direction.
    """
    middle = points[:, :2].mean(axis=0)
    A, b, sigma = _equations(points, origins, middle, params)
    weights = np.ones(len(b))
    for _ in range(params.rounds):
        solution, information = _solved(A, b, weights / sigma**2, params)
        residual = np.abs(A @ solution - b) / sigma
        weights = np.minimum(1.0, params.outlier / np.maximum(residual, 1e-9))
    covariance = np.linalg.inv(information) * params.independent
    std = float(np.sqrt(max(covariance[0, 0], covariance[1, 1])))
    x, y = (middle + solution[:2]).tolist()
    radius = max(float(solution[4]), 0.0) / _MEAN_DEPTH if origins is not None else 0.0
    return UprightAxis(
        x=x, y=y, slope_x=float(solution[2]), slope_y=float(solution[3]), radius=radius,
        std=max(std, params.least_std),
    )  # fmt: skip


def _equations(
    points: Floats, origins: Floats | None, middle: Floats, params: AxisFitParams
) -> tuple[Floats, Floats, Floats]:
    """Rows of A (2N, 5), of the right hand side and of sigmas: across each ray, then along it."""
    xy, h = points[:, :2] - middle, points[:, 2]
    if origins is None:
        along = np.tile((1.0, 0.0), (len(points), 1))
    else:
        ray = points[:, :2] - origins[:, :2]
        along = ray / np.maximum(np.linalg.norm(ray, axis=1, keepdims=True), 1e-9)
    across = np.column_stack((-along[:, 1], along[:, 0]))
    known = 0.0 if origins is None else -1.0
    A = np.concatenate([_rows(across, h, 0.0), _rows(along, h, known)])
    b = np.concatenate([(across * xy).sum(axis=1), (along * xy).sum(axis=1)])
    stds = (params.across_std, params.across_std if origins is None else params.range_std)
    return A, b, np.repeat(stds, len(points))


def _rows(direction: Floats, h: Floats, depth: float) -> Floats:
    return np.column_stack((direction, direction * h[:, None], np.full(len(h), depth)))


def _solved(A: Floats, b: Floats, weights: Floats, params: AxisFitParams) -> tuple[Floats, Floats]:
    """Solution (5,) and its information (5, 5); slopes and depth are held near what posts have."""
    held = np.diag((1e-6, 1e-6, params.slope_std**-2, params.slope_std**-2, 0.05**-2))
    held *= 10.0 * params.independent
    held[:2] /= 10.0 * params.independent
    expected = np.array((0.0, 0.0, 0.0, 0.0, 0.04))
    information = (A * weights[:, None]).T @ A + held
    return np.linalg.solve(information, (A * weights[:, None]).T @ b + held @ expected), information
