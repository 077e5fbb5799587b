"""How long one side's fit takes, turn by turn so that a busy moment meets all, and how often it is right."""

from __future__ import annotations

import importlib
import importlib.util
import math
import time
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.perception.corridor_fit import CorridorFitParams
from navcore.perception.line_consensus import best_lines
from navcore.perception.row_ransac import RansacParams, best_inliers

Floats = NDArray[np.float64]
POINTS = 40
OUTLIERS = (0.3, 0.5)
# Camera 0.8 m above the ground; 1-sigma of a foot's ray (dimensionless), of the plants about their line, m.
HEIGHT, RAY_STD, PLANT_STD = 0.8, 0.003, 0.03
RIGHT_RAD = 0.03
_NOISE = (RAY_STD, RAY_STD, CorridorFitParams().plant_std, CorridorFitParams().curve, PLANT_STD)


@dataclass(frozen=True, slots=True)
class FitTime:
    """Median seconds of one fit, and in how many of `n` it found the line."""

    seconds: float
    right: int
    n: int


def fit_times(*, rounds: int, seed: int) -> dict[str, FitTime]:
    """Our exact consensus, paper A's RANSAC, and scikit-image's where that is installed, on the same points."""
    fits = {"ours": _exact, "RANSAC as published": _published}
    if importlib.util.find_spec("skimage"):
        fits["scikit-image RANSAC"] = _scikit_image
    seconds: dict[str, list[float]] = {name: [] for name in fits}
    right = dict.fromkeys(fits, 0)
    for number in range(rounds + 3):
        rays, slope = _points(np.random.default_rng((seed, number)))
        for name, fit in fits.items():
            started = time.perf_counter()
            found = fit(rays)
            if number >= 3:  # the first calls compile
                seconds[name].append(time.perf_counter() - started)
                right[name] += found is not None and abs(found - slope) < RIGHT_RAD
    return {name: FitTime(float(np.median(taken)), right[name], rounds) for name, taken in seconds.items()}


def _points(rng: np.random.Generator) -> tuple[Floats, float]:
    """Rays (N, 2), across and down per metre ahead, of plants on one line and others; the line's slope."""
    outliers = round(POINTS * rng.uniform(*OUTLIERS))
    slope, aside = math.tan(rng.uniform(-0.15, 0.15)), rng.uniform(-2.0, -1.0)
    ahead = rng.uniform(2.5, 12.0, POINTS)
    across = aside + slope * ahead + rng.normal(0.0, PLANT_STD, POINTS)
    across[:outliers] = rng.uniform(-6.0, 6.0, outliers)
    rays = np.column_stack((across, np.full(POINTS, HEIGHT))) / ahead[:, None]
    return rays + rng.normal(0.0, RAY_STD, rays.shape), slope


def _exact(rays: Floats) -> float | None:
    lines = best_lines(rays, 1, (0.0, 0.0, HEIGHT), _NOISE)
    return float(lines[0, 0]) if len(lines) else None


def _published(rays: Floats) -> float | None:
    """In the picture, 12 px at 1280: as pixels of a camera of 60 deg."""
    pixels = rays * 1100.0
    params = RansacParams()
    inliers = best_inliers(pixels, params.inlier_distance_px, params, np.random.default_rng(params.seed))
    return _slope(rays[inliers])


def _scikit_image(rays: Floats) -> float | None:
    measure = importlib.import_module("skimage.measure")
    _, inliers = measure.ransac(
        rays * 1100.0, measure.LineModelND, min_samples=2, residual_threshold=12.0, max_trials=80,
        rng=RansacParams().seed,
    )  # fmt: skip
    return None if inliers is None else _slope(rays[inliers])


def _slope(rays: Floats) -> float | None:
    """Direction of the line across = m + b down, least squares."""
    if len(rays) < 2:
        return None
    A = np.column_stack((np.ones(len(rays)), rays[:, 1]))
    return float(np.linalg.lstsq(A, rays[:, 0], rcond=None)[0][0])
