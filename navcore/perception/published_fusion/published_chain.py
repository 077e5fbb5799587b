"""Paper B's chains from sensors to the row: camera and 2D LiDAR fused, and its two rivals with one sensor each.

All of them speak the driving frame of their camera: `base_link`, turned by pi for a rear camera.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import CameraName, DetectedObject
from navcore.perception.image_lines import driving_camera, looks_back
from navcore.perception.published_fusion.constraint_fit import ConstraintFit, ConstraintFitParams
from navcore.perception.published_fusion.point_ransac import PointRansac, PointRansacParams
from navcore.perception.published_fusion.published_rows import PublishedRow, PublishedRows, PublishedRowsParams
from navcore.perception.published_fusion.trunk_association import (
    AssociatedTrunk,
    TrunkAssociation,
    TrunkAssociationParams,
    checked_boxes,
)
from navcore.perception.scan.dbscan import DbscanParams, centroids, dbscan
from navcore.perception.scan.scan_filter import ScanFilterParams, scan_filter
from navcore.perception.scan.scan_points import ScanPoints

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

NO_RETURNS = "the LiDAR sees nothing: is it covered?"


@dataclass(frozen=True, slots=True, kw_only=True)
class PublishedFusionParams:
    """Every stage's own values.

    Attributes:
        min_confidence: boxes below are not used, 0 to 1 (paper B: 0.5, of its own detector; the shipped one is as
            sure of what it finds at 0.3, and above it too few trunks are left to enter a row).
        vision_range: feet further away are out of range for vision alone, m. Open in the paper.
    """

    min_confidence: float = 0.3
    vision_range: float = 8.0
    filter: ScanFilterParams = ScanFilterParams()
    dbscan: DbscanParams = DbscanParams()
    association: TrunkAssociationParams = TrunkAssociationParams()
    constraint: ConstraintFitParams = ConstraintFitParams()
    ransac: PointRansacParams = PointRansacParams()
    rows: PublishedRowsParams = PublishedRowsParams()


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PublishedView:
    """What one picture and one scan gave, in the driving frame.

    Attributes:
        found: the row, its lines and trunks.
        objects: boxes that were sure enough. associations: the trunk of each, None where there is none.
        scan: (M, 2) filtered points, m. labels: (M,) their clusters, -1 for noise.
    """

    found: PublishedRow
    objects: tuple[DetectedObject, ...] = ()
    associations: tuple[AssociatedTrunk | None, ...] = ()
    scan: Floats
    labels: Ints


class RowChain(Protocol):
    """From boxes and a scan, whichever it uses, to the row. Feed it all pairs in order, or `forget` in between."""

    def process(self, stamp_ns: int, objects: Sequence[DetectedObject], points: ScanPoints) -> PublishedView:
        """The row at `stamp_ns` from boxes in undistorted pixels and a scan in `base_link` at that time.

        Raises NotFiniteError for boxes that are no numbers.
        """
        ...

    def forget(self) -> None:
        """The next pair is of another place."""
        ...


class PublishedFusion:
    """Paper B's own: trunks that the camera knows, where the LiDAR says they are; GCA; Kalman."""

    def __init__(self, camera: PinholeCamera, mount: LidarMount, params: PublishedFusionParams) -> None:
        """Both mounted in `base_link`."""
        self._back, self._params = looks_back(camera), params
        self._association = TrunkAssociation(
            driving_camera(camera), _turned(mount) if self._back else mount, params.association
        )
        self._rows = PublishedRows(ConstraintFit(params.constraint), params.rows, _name(self._back))

    def process(self, stamp_ns: int, objects: Sequence[DetectedObject], points: ScanPoints) -> PublishedView:
        """See `RowChain`."""
        sure = _sure(objects, self._params)
        scan, labels = _clusters(points, self._back, self._params)
        associations = self._association.associate(sure, scan, labels)
        trunks, confidences = _trunks(sure, associations)
        found = self._rows.update(stamp_ns, trunks, confidences, _fault(points))
        return PublishedView(found=found, objects=sure, associations=associations, scan=scan, labels=labels)

    def forget(self) -> None:
        """See `RowChain`."""
        self._rows.forget()


class LidarRansac:
    """Paper B's rival with the LiDAR alone: every cluster is a trunk; RANSAC for each side."""

    def __init__(self, params: PublishedFusionParams, *, backwards: bool = False) -> None:
        self._back, self._params = backwards, params
        self._rows = PublishedRows(PointRansac(params.ransac), params.rows, _name(backwards))

    def process(self, stamp_ns: int, objects: Sequence[DetectedObject], points: ScanPoints) -> PublishedView:
        """See `RowChain`; boxes are not looked at."""
        scan, labels = _clusters(points, self._back, self._params)
        trunks = centroids(scan, labels)
        found = self._rows.update(stamp_ns, trunks, np.ones(len(trunks)), _fault(points))
        return PublishedView(found=found, scan=scan, labels=labels)

    def forget(self) -> None:
        """See `RowChain`."""
        self._rows.forget()


class VisionRansac:
    """Paper B's rival with the camera alone: the feet of sure boxes on flat ground; RANSAC for each side."""

    def __init__(self, camera: PinholeCamera, params: PublishedFusionParams) -> None:
        """`camera` is mounted in `base_link`."""
        self._camera, self._params = driving_camera(camera), params
        self._rows = PublishedRows(PointRansac(params.ransac), params.rows, _name(looks_back(camera)))

    def process(self, stamp_ns: int, objects: Sequence[DetectedObject], points: ScanPoints) -> PublishedView:
        """See `RowChain`; the scan is not looked at."""
        sure = _sure(objects, self._params)
        feet = self._camera.ground(np.array([((o.x1 + o.x2) / 2, o.y2) for o in sure]).reshape(-1, 2))
        near = np.hypot(feet[:, 0] - self._camera.x, feet[:, 1] - self._camera.y) <= self._params.vision_range
        confidences = np.array([o.confidence for o in sure])
        found = self._rows.update(stamp_ns, feet[near], confidences[near])
        return PublishedView(found=found, objects=sure, scan=np.empty((0, 2)), labels=np.empty(0, dtype=np.int64))

    def forget(self) -> None:
        """See `RowChain`."""
        self._rows.forget()


def _sure(objects: Sequence[DetectedObject], params: PublishedFusionParams) -> tuple[DetectedObject, ...]:
    checked_boxes(objects)
    return tuple(o for o in objects if o.confidence >= params.min_confidence)


def _clusters(points: ScanPoints, backwards: bool, params: PublishedFusionParams) -> tuple[Floats, Ints]:
    """Filtered points (M, 2) in the driving frame, and the cluster of each (M,)."""
    filtered = scan_filter(points, params.filter)
    kept = filtered.xy[filtered.valid]
    labels = dbscan(kept, eps=params.dbscan.eps, min_points=params.dbscan.min_points, centre=points.centre)
    return (-kept if backwards else kept), labels


def _trunks(
    objects: Sequence[DetectedObject], associations: Sequence[AssociatedTrunk | None]
) -> tuple[Floats, Floats]:
    """Each trunk once, (K, 2), with the confidence (K,) of its surest box."""
    best: dict[int, tuple[float, float, float]] = {}
    for box, trunk in zip(objects, associations, strict=True):
        if trunk and box.confidence > best.get(trunk.trunk, (0.0, 0.0, -1.0))[2]:
            best[trunk.trunk] = (trunk.x, trunk.y, box.confidence)
    found = np.array(list(best.values()), dtype=np.float64).reshape(-1, 3)
    return found[:, :2], found[:, 2]


def _fault(points: ScanPoints) -> str:
    return "" if points.valid.any() else NO_RETURNS


def _turned(mount: LidarMount) -> LidarMount:
    """The same mount in the driving frame of a rear camera."""
    return replace(mount, x=-mount.x, y=-mount.y, yaw=mount.yaw + math.pi)


def _name(backwards: bool) -> CameraName:
    return CameraName.REAR if backwards else CameraName.FRONT
