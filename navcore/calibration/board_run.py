"""Where a board is in a scan: a straight run of rays of the right length, near where the camera says."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError, NotFiniteError
from navcore.geometry.angles import wrap_all

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class BoardRunParams:
    """What a board looks like to a 2D LiDAR. Ours; set on rendered boards.

    Attributes:
        range_std: 1-sigma of a ray's distance, m; > 0. 1 cm is a good RPLIDAR below 2 m.
        gap: rays next to each other whose ends differ by more, m, do not lie on one board; 5 range_std or more.
        straight: largest root mean square distance from the run's line, in range_std; > 1.
        least_rays: on the board; 5 or more.
        shortest: of the run, share of what the camera expects; 0 to 1. longest: the same; > 1.
        away: of the run's middle from where the camera expects it, m, and `turned_deg`: of its direction, with a
            mount that is known roughly. Both shrink to a third once it has been fitted.
    """

    range_std: float = 0.01
    gap: float = 0.08
    straight: float = 2.0
    least_rays: int = 8
    shortest: float = 0.6
    longest: float = 1.3
    away: float = 0.35
    turned_deg: float = 30.0


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PlainScan:
    """Rays in the order of their angles, those without an end left out; several turns of a robot that stands are one.

    Attributes:
        angles: (N,) rad in (-pi, pi], ascending. distances: (N,) m, > 0.
        step: angle between rays, rad, as an edge meets it.
    """

    angles: Floats
    distances: Floats
    step: float

    def points(self) -> Floats:
        """Where the rays end (N, 2) in the sensor's plane, m."""
        return np.asarray(self.distances[:, None] * np.column_stack((np.cos(self.angles), np.sin(self.angles))))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BoardRun:
    """The rays on a board.

    Attributes:
        points: (N, 2) their ends in the sensor's plane, m. ends: (2, 2) of the board along the line, m, the first at
            the smaller angle: half a ray beyond its last points. end_std: 1-sigma of the ends along the line, m.
    """

    points: Floats
    ends: Floats
    end_std: Floats


def plain_scan(angles: Floats, distances: Floats) -> PlainScan:
    """Of rays in any order: angles rad, distances m, 0 for none. Raises NotFiniteError, InputError for no rays."""
    angles, distances = np.asarray(angles, dtype=np.float64), np.asarray(distances, dtype=np.float64)
    if not (np.all(np.isfinite(angles)) and np.all(np.isfinite(distances))):
        raise NotFiniteError("A ray of the scan is NaN or infinite.")
    hit = distances > 0.0
    if np.count_nonzero(hit) < 10:
        raise InputError("The scan has fewer than 10 rays that hit something. Look at the LiDAR.")
    turned = wrap_all(angles[hit])
    order = np.argsort(turned, kind="stable")
    return PlainScan(angles=turned[order], distances=distances[hit][order], step=_step(np.diff(turned[order])))


def _step(steps: Floats) -> float:
    """The mean gap in which an edge falls: wider gaps hold more edges. Turns need not be evenly interleaved."""
    usual = steps[steps < math.radians(3.0)]
    return float(np.sum(usual**2) / np.sum(usual)) if np.sum(usual) > 0.0 else math.radians(1.0)


def find_board(scan: PlainScan, outline: Floats, params: BoardRunParams, *, rough: bool) -> BoardRun | str:
    """The board whose plate's corners (4, 3) are expected there in the LiDAR's frame, m, or why it is not seen."""
    expected = plane_cut(outline)
    if expected is None:
        middle, length, direction = outline[:, :2].mean(axis=0), None, None
    else:
        middle, length = expected.mean(axis=0), float(np.linalg.norm(expected[1] - expected[0]))
        direction = (expected[1] - expected[0]) / max(length, 1e-9)
    candidates = [run for first, last in _runs(scan, params) if (run := _line_run(scan, first, last, params))]
    scale = 1.0 if rough else 1.0 / 3.0
    fitting = [
        (miss, run)
        for run in candidates
        if (miss := _miss(run, middle, length if not rough else None, direction, params, scale, outline)) is not None
    ]
    if not fitting:
        return _no_run(scan, middle, params)
    return min(fitting, key=lambda pair: pair[0])[1]


def plane_cut(outline: Floats) -> Floats | None:
    """Where a convex outline (N, 3) in the LiDAR's frame cuts the LiDAR's plane z = 0: (2, 2), or None."""
    ends: list[Floats] = []
    for a, b in zip(outline, np.roll(outline, -1, axis=0), strict=True):
        if (a[2] > 0.0) != (b[2] > 0.0):
            ends.append(a[:2] + (b[:2] - a[:2]) * a[2] / (a[2] - b[2]))
    return np.array(ends) if len(ends) == 2 else None


def _runs(scan: PlainScan, params: BoardRunParams) -> list[tuple[int, int]]:
    """First and last ray (inclusive) of each stretch without a gap in angle or distance."""
    apart = np.abs(np.diff(scan.distances)) > params.gap
    missing = np.diff(scan.angles) > 4.5 * scan.step
    cuts = np.flatnonzero(apart | missing)
    firsts, lasts = np.concatenate(([0], cuts + 1)), np.concatenate((cuts, [len(scan.angles) - 1]))
    long = lasts - firsts + 1 >= params.least_rays
    return list(zip(firsts[long].tolist(), lasts[long].tolist(), strict=True))


def _line_run(scan: PlainScan, first: int, last: int, params: BoardRunParams) -> BoardRun | None:
    """The run as a line; None if it is not straight."""
    points = scan.points()[first : last + 1]
    centre = points.mean(axis=0)
    _, _, axes = np.linalg.svd(points - centre, full_matrices=False)
    normal = axes[1]
    if math.sqrt(float(np.mean(((points - centre) @ normal) ** 2))) > params.straight * params.range_std:
        return None
    half = scan.step / 2.0
    ends, stds = zip(
        *(
            _end(scan.angles[k] + side * half, centre, normal, scan.step)
            for k, side in ((first, -1.0), (last, 1.0))
        ),
        strict=True,
    )  # fmt: skip
    ends_xy = np.array(ends)
    return BoardRun(points=points, ends=ends_xy, end_std=np.array(stds)) if np.all(np.isfinite(ends_xy)) else None


def _end(angle: float, centre: Floats, normal: Floats, step: float) -> tuple[Floats, float]:
    """Where a ray at that angle meets the line, and how far a ray's step moves that, 1-sigma of an even spread."""
    ray = np.array([math.cos(angle), math.sin(angle)])
    across = float(ray @ normal)
    if abs(across) < 0.05:
        return np.full(2, np.nan), math.nan
    distance = float(centre @ normal) / across
    return distance * ray, abs(distance / across) * step / math.sqrt(12.0)


def _miss(
    run: BoardRun, middle: Floats, length: float | None, direction: Floats | None, params: BoardRunParams,
    scale: float, outline: Floats,
) -> float | None:  # fmt: skip
    """How far the run is from what is expected, m; None if too far. `length`: expected, m; None where it is not told
    well, when the plate's own sizes bound it."""
    along = run.ends[1] - run.ends[0]
    long = float(np.linalg.norm(along))
    sides = np.linalg.norm(outline - np.roll(outline, 1, axis=0), axis=1)
    shortest, longest = (length, length) if length is not None else (0.4 * sides.min(), math.hypot(*sides[:2]))
    if not params.shortest * shortest <= long <= params.longest * longest:
        return None
    if direction is not None and abs(float(along @ direction)) < long * math.cos(
        math.radians(params.turned_deg * scale)
    ):
        return None
    miss = float(np.linalg.norm(run.ends.mean(axis=0) - middle))
    return miss if miss <= params.away * scale else None


def _no_run(scan: PlainScan, middle: Floats, params: BoardRunParams) -> str:
    bearing = math.degrees(math.atan2(middle[1], middle[0]))
    return (
        f"the scan has no straight run of the board's length within {100 * params.away:.0f} cm of where the camera "
        f"sees the board ({np.hypot(*middle):.2f} m away at {bearing:.0f} deg). Hold the board into the LiDAR's "
        "plane, free of hands and other things"
    )
