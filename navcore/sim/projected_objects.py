"""Boxes of trunks and posts straight from the world's truth, with a detector's faults: row perception without pixels.

It stands in for camera and detector where rendering would cost too much; what it knows no picture could show (a leaf
before a trunk, a glare) it does not imitate.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.pinhole import PinholeCamera, rotation_from_rpy
from navcore.messages import DetectedObject, ObjectKind, SimTruth
from navcore.sim.orchard import Orchard

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class ProjectedObjectsParams:
    """Faults of the imagined detector.

    Attributes:
        reach: objects further away are not found, m.
        edge_std_px: 1-sigma of each box edge.
        missed: share of visible objects that are not found, 0 to 1.
        missed_far: share at `reach`; in between it grows with the square of the distance.
        false_boxes: mean number of boxes on nothing, per frame.
        hidden: an object is not found if more than this share of its width lies behind nearer ones.
        least_height_px: smaller boxes are not found.
    """

    reach: float = 14.0
    edge_std_px: float = 1.5
    missed: float = 0.05
    missed_far: float = 0.5
    false_boxes: float = 0.4
    hidden: float = 0.5
    least_height_px: float = 10.0


class ProjectedObjects:
    """A `Detector` that looks at the truth instead of the picture. Call `look_from` before each `detect`."""

    def __init__(
        self, orchard: Orchard, camera: PinholeCamera, params: ProjectedObjectsParams, rng: np.random.Generator
    ) -> None:
        self._camera, self._params, self._rng = camera, params, rng
        self._plants = np.vstack((orchard.posts[:, :5], orchard.trunks[:, :5]))
        kinds = (ObjectKind.POST,) * len(orchard.posts) + (ObjectKind.TRUNK,) * len(orchard.trunks)
        self._kinds = np.array(kinds, dtype=object)
        self._visible_height = max(orchard.canopy_bottom_m, 0.5)
        self._truth: SimTruth | None = None

    def look_from(self, truth: SimTruth) -> None:
        """Place the camera's robot."""
        self._truth = truth

    def detect(self, image: NDArray[np.uint8]) -> tuple[DetectedObject, ...]:
        """Boxes as a detector would give them, nearest first; the picture is not looked at."""
        if self._truth is None:
            return ()
        boxes, kinds = self._boxes(self._truth)
        found = [self._disturb(box, kind) for box, kind in zip(boxes, kinds, strict=True)]
        return (*found, *self._false_boxes())

    def _boxes(self, truth: SimTruth) -> tuple[Floats, list[ObjectKind]]:
        """True boxes (N, 4) of what would be found, nearest first."""
        near = np.hypot(self._plants[:, 0] - truth.x, self._plants[:, 1] - truth.y) < self._params.reach + 1.0
        plants, kinds = self._plants[near], self._kinds[near]
        base = self._in_base(plants[:, :3], truth)
        boxes = self._project(base, plants)
        distance = np.hypot(base[:, 0] - self._camera.x, base[:, 1] - self._camera.y)
        order = np.argsort(distance, kind="stable")
        kept = self._found(boxes[order], distance[order])
        return boxes[order][kept], list(kinds[order][kept])

    def _in_base(self, points: Floats, truth: SimTruth) -> Floats:
        rotation = rotation_from_rpy(truth.roll, truth.pitch, truth.yaw)
        return np.asarray((points - (truth.x, truth.y, 0.0)) @ rotation)

    def _project(self, base: Floats, plants: Floats) -> Floats:
        """Boxes (N, 4) from foot, top and radius; NaN where behind the camera."""
        top = base.copy()
        top[:, 2] += np.minimum(plants[:, 3], self._visible_height)
        feet, tops = self._camera.project(base), self._camera.project(top)
        sideways = np.hypot(base[:, 0] - self._camera.x, base[:, 1] - self._camera.y)
        half = self._camera.fx * plants[:, 4] / np.maximum(sideways, 0.3)
        return np.column_stack((feet[:, 0] - half, tops[:, 1], feet[:, 0] + half, feet[:, 1]))

    def _found(self, boxes: Floats, distance: Floats) -> NDArray[np.intp]:
        """Indices of those that a detector would find, boxes sorted by distance."""
        c, p = self._camera, self._params
        seen = (boxes[:, 0] > 1) & (boxes[:, 2] < c.width_px - 1) & (boxes[:, 3] < c.height_px - 1)
        seen &= (boxes[:, 3] - np.maximum(boxes[:, 1], 0) >= p.least_height_px) & (distance < p.reach)
        miss = p.missed + (p.missed_far - p.missed) * np.square(np.minimum(distance / p.reach, 1.0))
        seen &= self._rng.random(len(boxes)) >= miss
        covered = np.zeros(c.width_px, dtype=bool)
        kept = [i for i in np.flatnonzero(seen) if not self._hides(covered, boxes[i])]
        return np.array(kept, dtype=np.intp)

    def _hides(self, covered: NDArray[np.bool_], box: Floats) -> bool:
        """True if the box lies behind nearer ones; else it covers its columns from now on."""
        u0, u1 = int(box[0]), max(int(box[2]), int(box[0]) + 1)
        hidden = float(covered[u0:u1].mean()) > self._params.hidden
        covered[u0:u1] = True
        return hidden

    def _disturb(self, box: Floats, kind: ObjectKind) -> DetectedObject:
        c = self._camera
        x1, y1, x2, y2 = (box + self._rng.normal(0.0, self._params.edge_std_px, 4)).tolist()
        bottom = min(y2, float(c.height_px))
        confidence = float(self._rng.uniform(0.5, 0.95))
        top = max(min(y1, bottom - 1.0), 0.0)
        return DetectedObject(kind=kind, confidence=confidence, x1=min(x1, x2 - 1.0), y1=top, x2=x2, y2=bottom)

    def _false_boxes(self) -> tuple[DetectedObject, ...]:
        c = self._camera
        boxes = []
        for _ in range(self._rng.poisson(self._params.false_boxes)):
            u, v = self._rng.uniform(0, c.width_px - 30), self._rng.uniform(0.45, 0.95) * c.height_px
            h = self._rng.uniform(15, 120)
            boxes.append(
                DetectedObject(
                    kind=ObjectKind.TRUNK,
                    confidence=0.5,
                    x1=u,
                    y1=max(v - h, 0.0),
                    x2=u + self._rng.uniform(5, 25),
                    y2=v,
                )
            )
        return tuple(boxes)
