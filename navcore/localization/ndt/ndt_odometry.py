"""Where a LiDAR went, from its scans alone: each is laid onto a map of those before it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from navcore.geometry.point_cloud import PointCloud
from navcore.geometry.screw import Screw
from navcore.geometry.se3 import SE3
from navcore.geometry.voxel_means import voxel_means
from navcore.localization.ndt.ndt_matcher import NdtMatcher, NdtMatcherParams
from navcore.localization.ndt.registration import Floats, Registration
from navcore.localization.ndt.start_search import StartSearchParams
from navcore.maps.ndt.ndt_map import NdtMap, NdtMapParams


@dataclass(frozen=True, slots=True, kw_only=True)
class NdtOdometryParams:
    """Parameters of `NdtOdometry`.

    Attributes:
        thinned: scans are matched by the means of voxels of this size, m, above 0.
        moved, turned: a scan is added to the map when it is that far from the last one that was, m and rad.
        reach: the map forgets what is further from the LiDAR, m, above 0.
        target: how scans become Gaussians. matcher: of the match; it starts where the LiDAR is if it goes on as it
            went, so it need not look around far.
    """

    thinned: float = 0.4
    moved: float = 0.3
    turned: float = 0.05
    reach: float = 80.0
    target: NdtMapParams = field(default_factory=NdtMapParams)
    matcher: NdtMatcherParams = field(
        default_factory=lambda: NdtMatcherParams(search=StartSearchParams(reach=0.4, turn=0.14, step=0.2))
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OdometryStep:
    """One scan's place in the frame of the first one; `registration` is None for the first scan.

    Where the registration has a reason, the pose is only what constant speed makes of it.
    """

    T_odom_lidar: SE3
    registration: Registration | None = None


class NdtOdometry:
    """Scan to map; scans come in their order, about evenly in time."""

    def __init__(self, params: NdtOdometryParams = NdtOdometryParams()) -> None:
        self._params = params
        self._map = NdtMap(params.target)
        self._matcher = NdtMatcher(self._map, params.matcher)
        self._pose, self._motion = SE3.identity(), SE3.identity()
        self._added: SE3 | None = None

    def step(self, cloud: PointCloud, period_s: float) -> OdometryStep:
        """The next scan, `period_s` after the last one; points without times are taken all at once.

        Raises NotFiniteError and NdtMapError for points that are nowhere.
        """
        points = _still(cloud, self._motion, period_s)
        if self._added is None:
            self._add(points)
            return OdometryStep(T_odom_lidar=self._pose)
        found = self._matcher.match(voxel_means(points, self._params.thinned), self._pose @ self._motion)
        self._motion = self._pose.inverse() @ found.T_target_source
        self._pose = found.T_target_source
        if found.converged and self._is_new(self._added):
            self._add(_still(cloud, self._motion, period_s))
        return OdometryStep(T_odom_lidar=self._pose, registration=found)

    def _is_new(self, added: SE3) -> bool:
        away = added.inverse() @ self._pose
        return float(np.linalg.norm(away.t)) > self._params.moved or away.angle() > self._params.turned

    def _add(self, points: Floats) -> None:
        if not len(points):
            return
        near = np.hypot(points[:, 0], points[:, 1]) <= self._params.reach
        self._map.keep_near(self._pose.t, self._params.reach)
        self._map.add(self._pose.apply(points[near]))
        self._added = self._pose


def _still(cloud: PointCloud, motion: SE3, period_s: float) -> Floats:
    """Points as if all had been taken at the cloud's stamp, the last period's motion going on."""
    if not len(cloud) or not cloud.times.any():
        return cloud.points
    return Screw.between(SE3.identity(), motion).carry(cloud.times / period_s, cloud.points)
