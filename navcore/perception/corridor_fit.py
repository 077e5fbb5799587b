"""Both sides of the corridor at once, as parallel lines on the ground, with the camera's pitch as a fourth unknown.

Better than the published fit of each side in the image: the exact consensus over all pairs replaces sampling, one
hidden side is carried by the corridor's width and the other side, and the pitch of a robot on rough ground is
estimated instead of spoiling the distances.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.pinhole import PinholeCamera
from navcore.perception import corridor_kernels as kernels
from navcore.perception import foot_kernels
from navcore.perception.scan_evidence import ScanEvidence, nothing_scanned

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class CorridorFitParams:
    """How well a foot point tells where a plant stands. Ours; set on rendered frames.

    Attributes:
        foot_u_px, foot_v_px: 1-sigma of a box's foot at 640 px image width, scaled with the width; > 0.
        plant_std: 1-sigma of the plants about their line, m; scanned_std: the same for scanned ones, of which the fit
            has to find out which stand on its lines, not where these are to the centimetre.
        curve: extra scatter per squared metre of distance, 1/m: rows are not quite straight.
        max_range: feet further away than this do not help to find a corridor, m; `far_range`: nor to follow one. The
            first two plants tell a row's direction badly, and before its entrance they are the nearest.
        max_points, far_points: the nearest so many are used; bounds the time of a fit.
        lines, tries: best single lines that are combined, and corridors that are refined, when there is no track.
    """

    foot_u_px: float = 1.5
    foot_v_px: float = 2.0
    plant_std: float = 0.06
    scanned_std: float = 0.10
    curve: float = 0.0005
    max_range: float = 14.0
    far_range: float = 24.0
    max_points: int = 40
    far_points: int = 60
    lines: int = 10
    tries: int = 4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Corridor:
    """Estimate of (offset, heading, width, pitch), m and rad, in the driving frame.

    Attributes:
        state: (4,).
        covariance: (4, 4).
        sides: (N,) +1 for a foot on the left line, -1 on the right, 0 for one that is no evidence.
        xy: (N, 2) where the feet stand in the driving frame, m; NaN where not on the ground. A foot that belongs to
            a scanned plant stands where that does.
        plant_sides: (M,) likewise, of the scanned plants.
        told_x, told_sides: (K,) of all plants, feet and scanned ones, each once: how far ahead, m, and side.
    """

    state: Floats
    covariance: Floats
    sides: Ints
    xy: Floats
    plant_sides: Ints
    told_x: Floats
    told_sides: Ints

    @property
    def x(self) -> Floats:
        """(N,) distance of the feet ahead of the driving frame's origin, m."""
        return self.xy[:, 0]

    def on_sides(self) -> tuple[int, int]:
        """How many plants stand on the left line, and on the right one."""
        return int(np.count_nonzero(self.told_sides > 0)), int(np.count_nonzero(self.told_sides < 0))


class CorridorFit:
    """The fit for one camera, mounted in its driving frame."""

    def __init__(self, camera: PinholeCamera, params: CorridorFitParams) -> None:
        self._camera = camera
        self._params = params
        self._mount = (camera.x, camera.y, camera.z)
        scale = camera.width_px / 640 / camera.fx
        scatter = params.plant_std, params.curve, params.scanned_std
        self._noise = (params.foot_u_px * scale, params.foot_v_px * scale, *scatter)

    def acquire(
        self, feet: Floats, mean: Floats, information: Floats, reach: tuple[float, float],
        scan: ScanEvidence | None = None,
    ) -> Corridor:  # fmt: skip
        """The best corridor for feet (N, 2), pixels, over all whose offset and heading lie within `reach` (m, rad)
        of the prior's.
        """
        p, scan = self._params, scan or nothing_scanned(len(feet))
        rays, used = self._rays(feet, scan, p.max_range, p.max_points)
        pairs = foot_kernels.pairs(rays, scan.paired, scan.plants, self._mount)
        scanned = nearest_plants(scan.plants, p.max_range, p.max_points), pairs
        start, _ = kernels.acquire(
            rays[used], scanned, mean, information, self._mount, self._noise, p.lines, p.tries, reach
        )  # fmt: skip
        return self._refine(start, rays, used, scan, mean, information, 1.0)

    def follow(self, feet: Floats, mean: Floats, information: Floats, scan: ScanEvidence | None = None) -> Corridor:
        """The corridor near the predicted one."""
        scan = scan or nothing_scanned(len(feet))
        rays, used = self._rays(feet, scan, self._params.far_range, self._params.far_points)
        return self._refine(mean, rays, used, scan, mean, information, 2.0)

    def _refine(
        self, start: Floats, rays: Floats, used: Ints, scan: ScanEvidence, mean: Floats, information: Floats,
        widen: float,
    ) -> Corridor:  # fmt: skip
        z, after, sides, xy, plant_sides = kernels.told(
            start, rays, used, scan.paired, scan.plants, mean, information, self._mount, self._noise, widen
        )  # fmt: skip
        told_x, told_sides = kernels.each_once(xy, sides, scan.paired, scan.plants, plant_sides)
        return Corridor(
            state=z, covariance=np.asarray(np.linalg.inv(after), dtype=np.float64), sides=sides, xy=xy,
            plant_sides=plant_sides, told_x=told_x, told_sides=told_sides,
        )  # fmt: skip

    def _rays(self, feet: Floats, scan: ScanEvidence, furthest: float, most: int) -> tuple[Floats, Ints]:
        """Rays (N, 2) as (s, t), and the indices of the nearest in range that are no scanned plant's feet."""
        rays = foot_rays(self._camera, feet)
        return rays, foot_kernels.nearest_alone(rays, scan.paired, self._camera.z / furthest, most)


def nearest_plants(plants: Floats, furthest: float, most: int) -> Floats:
    """The nearest `most` of plants (M, 4) up to `furthest` m away, nearest first."""
    away = np.hypot(plants[:, 0], plants[:, 1])
    near = np.argsort(away, kind="stable")[:most]
    return plants[near[away[near] <= furthest]]


def foot_rays(camera: PinholeCamera, feet: Floats) -> Floats:
    """Rays (1, s, -t) in the driving frame, as (s, t), (N, 2), of pixels (N, 2); NaN for those not ahead."""
    return np.asarray(foot_kernels.rays(feet, camera.compiled()), dtype=np.float64)
