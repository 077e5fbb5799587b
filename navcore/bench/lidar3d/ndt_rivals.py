"""Who lays a scan onto the map: ours, NDT as published, and small_gicp where it is installed."""

from __future__ import annotations

import importlib
import importlib.util
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from navcore.bench.lidar3d.ndt_scans import NdtScans, PlacedScan
from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.localization.ndt.ndt_matcher import WIDE_MATCH, NdtMatcher
from navcore.localization.ndt.published_ndt import PublishedNdt
from navcore.localization.ndt.registration import Registration
from navcore.localization.ndt.scan_follower import ScanFollower
from navcore.maps.ndt.ndt_map import NdtMap

Floats = NDArray[np.float64]

OURS, OURS_WIDE, PUBLISHED = "ours", "ours, wide search", "NDT as published"
# Kind of registration and voxel of the map, m: near its defaults, correspondences up to 1 m (as small_gicp has it).
SMALL_GICP = {
    "small_gicp PLANE_ICP 0.5 m": ("PLANE_ICP", 0.5),
    "small_gicp PLANE_ICP 0.25 m": ("PLANE_ICP", 0.25),
    "small_gicp GICP 0.5 m": ("GICP", 0.5),
    "small_gicp VGICP 0.5 m": ("VGICP", 0.5),
}
# About 4000 points of a scan are left.
THINNED_M = 0.4


@dataclass(frozen=True, slots=True, eq=False)
class Case:
    """A scan, thinned, and the guess to start from; `foreign` is the same scan as small_gicp wants it."""

    scan: PlacedScan
    points: Floats
    guess: SE3
    foreign: Any = field(default=None)


Rival = Callable[[Case], Registration | SE3]


def started(scans: NdtScans, off: float, turned: float, seed: int) -> list[Case]:
    """Every scan, its guess `off`, m, away in any direction and `turned`, rad, to one side."""
    rng = np.random.default_rng((seed, round(off * 1000)))
    cases = []
    for scan in scans.scans:
        way, side = rng.uniform(0.0, 2.0 * math.pi), rng.choice((-1.0, 1.0))
        T = scan.T_map_lidar
        shift = np.array((off * math.cos(way), off * math.sin(way), 0.0))
        guess = SE3(T.R @ SE3.from_rpy((0, 0, 0), yaw=float(side * turned)).R, T.t + shift)
        points = voxel_means(scan.points, THINNED_M)
        cases.append(Case(scan, points, guess, foreign_source(points)))
    return cases


def rivals(scans: NdtScans) -> dict[str, Rival]:
    """Those that can be measured here, on one thread each."""
    wide = NdtMatcher(scans.ndt_map, WIDE_MATCH)
    own: dict[str, Rival] = {
        OURS: partial(_ours, NdtMatcher(scans.ndt_map)),
        OURS_WIDE: partial(_ours, wide),
        PUBLISHED: partial(_ours, PublishedNdt(scans.ndt_map)),
    }
    return {**own, **_small_gicp(scans.points)}


def following_rivals(ndt_map: NdtMap, cloud: Floats) -> dict[str, Rival]:
    """The same where odometry leads from scan to scan, ours as the robot has it then; `cloud` (M, 3) for others."""
    return {
        OURS: partial(_ours, ScanFollower(ndt_map)),
        PUBLISHED: partial(_ours, PublishedNdt(ndt_map)),
        **_small_gicp(cloud),
    }


def pose_of(made: Registration | SE3) -> SE3:
    """T_map_lidar as a rival has it."""
    return made if isinstance(made, SE3) else made.T_target_source


def _ours(matcher: NdtMatcher | PublishedNdt | ScanFollower, case: Case) -> Registration:
    return matcher.match(case.points, case.guess)


def _installed() -> bool:
    return importlib.util.find_spec("small_gicp") is not None


def foreign_source(points: Floats) -> Any:
    """Points with normals and covariances; they are thin already."""
    if not _installed():
        return None
    library = importlib.import_module("small_gicp")
    return library.preprocess_points(points, downsampling_resolution=0.01, num_threads=1)[0]


def _small_gicp(cloud: Floats) -> dict[str, Rival]:
    if not _installed():
        return {}
    library = importlib.import_module("small_gicp")
    prepared = {
        size: library.preprocess_points(cloud, downsampling_resolution=size, num_threads=1)
        for size in sorted({size for _, size in SMALL_GICP.values()})
    }
    found: dict[str, Rival] = {}
    for name, (kind, size) in SMALL_GICP.items():
        if kind == "VGICP":
            voxels = library.GaussianVoxelMap(size)
            voxels.insert(prepared[min(prepared)][0])
            found[name] = partial(_by_voxels, library, voxels)
        else:
            found[name] = partial(_by_points, library, prepared[size], kind)
    return found


def _by_voxels(library: Any, voxels: Any, case: Case) -> SE3:
    found = library.align(voxels, case.foreign, init_T_target_source=case.guess.matrix(), num_threads=1)
    return SE3(np.array(found.T_target_source[:3, :3]), np.array(found.T_target_source[:3, 3]))


def _by_points(library: Any, target: Any, kind: str, case: Case) -> SE3:
    found = library.align(
        target[0], case.foreign, target[1], init_T_target_source=case.guess.matrix(), registration_type=kind,
        max_correspondence_distance=1.0, num_threads=1,
    )  # fmt: skip
    return SE3(np.array(found.T_target_source[:3, :3]), np.array(found.T_target_source[:3, 3]))
