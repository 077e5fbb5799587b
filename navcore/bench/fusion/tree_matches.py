"""Of the trees that the camera knows, which a fusion finds in the scan: ours and the published one, side by side."""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import median

import numpy as np
from numpy.typing import NDArray

from navcore.bench.fusion.segment_eyes import ChainEye, OurEye, Pictures
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.pinhole import rotation_from_rpy
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, CameraRequest, CameraView, DetectedObject, LidarScan, SimTruth
from navcore.runtime.simulation import robot_cameras
from navcore.sim.orchard import Orchard
from navcore.sim.trunk_sections import trunk_sections

Floats = NDArray[np.float64]

# An object is the tree whose foot lies nearest, if it lies within so many pixels and the next tree's foot does not.
FOOT_PX, OTHER_PX = 14.0, 28.0
# A place is a tree's if it lies nearer to it than this, m.
PLACE_M = 0.25
# What stands so much further from a tree's middle than another look at it did may still be the tree, m.
STILL_M = 0.04
# Objects further away are not counted, m.
REACH_M = 8.0
# A tree counts as associated once it was in so many pictures.
PICTURES = 3


@dataclass(frozen=True, slots=True, kw_only=True)
class TreeMatches:
    """Counts over one drive.

    Attributes:
        trees: that the camera knew in `PICTURES` pictures or more. found: of them, in as many, at the right place.
        right, wrong: pairs of an object and a place.
        thickness: errors of diameters, m, of trunks passed at 1 to 2 m.
    """

    trees: int
    found: int
    right: int
    wrong: int
    thickness: tuple[float, ...] = ()


class Tally:
    """Counts for one fusion."""

    def __init__(self) -> None:
        self._seen: dict[int, int] = {}
        self._found: dict[int, int] = {}
        self._right = self._wrong = 0
        self._thickness: dict[int, tuple[float, float]] = {}

    def add(self, tree: int, place: int | None) -> None:
        """An object that is `tree` was put at the place of tree `place`, -1 for no tree's; None: at no place."""
        self._seen[tree] = self._seen.get(tree, 0) + 1
        if place is None:
            return
        if place == tree:
            self._right += 1
            self._found[tree] = self._found.get(tree, 0) + 1
        else:
            self._wrong += 1

    def measure(self, tree: int, off: float, error: float) -> None:
        """A diameter minus the tree's true one, m, of what stands `off` m from it; of a tree and its stake the nearer
        one counts, and of that the newest.
        """
        if off <= self._thickness.get(tree, (math.inf, 0.0))[0] + STILL_M:
            self._thickness[tree] = min(off, self._thickness.get(tree, (off, 0.0))[0]), error

    def matches(self) -> TreeMatches:
        """So far."""
        seen = [tree for tree, n in self._seen.items() if n >= PICTURES]
        return TreeMatches(
            trees=len(seen), found=sum(self._found.get(tree, 0) >= PICTURES for tree in seen), right=self._right,
            wrong=self._wrong, thickness=tuple(error for _, error in self._thickness.values()),
        )  # fmt: skip


class WatchedEye:
    """Ours drives; the published fusion gets the same boxes and scans; what both make of them is counted."""

    def __init__(
        self, eye: OurEye, published: ChainEye, pictures: Pictures, orchard: Orchard, mount: LidarMount
    ) -> None:
        self._eye, self._published, self._pictures = eye, published, pictures
        self._camera = robot_cameras()[CameraName.FRONT]
        self._feet, self._sections = orchard.trunks[:, :3], trunk_sections(orchard, mount.z)
        self._ours, self._theirs = Tally(), Tally()

    @property
    def ours(self) -> TreeMatches:
        """What ours made of it."""
        return self._ours.matches()

    @property
    def published(self) -> TreeMatches:
        """What the published one made of the same."""
        return self._theirs.matches()

    def milliseconds(self) -> tuple[float | None, float | None]:
        """Of a look that showed a row, median, ours and the published one's; None where none did."""
        ours, theirs = self._eye.seconds, self._published.seconds
        return 1e3 * median(ours) if ours else None, 1e3 * median(theirs) if theirs else None

    def look(self, truth: SimTruth, request: CameraRequest, scans: tuple[LidarScan, ...] = ()) -> CameraView:
        """See `lockstep.Eye`."""
        view = self._eye.look(truth, request, scans)
        objects = self._pictures.objects
        if request.camera is CameraName.FRONT and request.offset is not None:
            self._published.feed(truth.stamp_ns, request, objects, scans)
            self._count(truth, view, objects)
        return view

    def _count(self, truth: SimTruth, view: CameraView, objects: tuple[DetectedObject, ...]) -> None:
        ours = {p.object: (p.x, p.y) for p in view.plants if p.object is not None}
        theirs = self._published_places()
        for i, tree in enumerate(self._trees(truth, objects)):
            if tree is not None:
                self._ours.add(tree, self._tree_at(truth, ours.get(i)))
                self._theirs.add(tree, self._tree_at(truth, theirs.get(_key(objects[i]))))
        for plant in view.plants:
            tree = self._tree_at(truth, (plant.x, plant.y))
            if tree is not None and tree >= 0 and abs(plant.x) < 1.0 and 1.0 < abs(plant.y) < 2.0:
                x, y = SE2(truth.x, truth.y, truth.yaw).apply_point(plant.x, plant.y)
                there = self._sections[tree]
                self._ours.measure(
                    tree, math.hypot(there[0] - x, there[1] - y), plant.diameter - 2.0 * float(there[2])
                )

    def _published_places(self) -> dict[tuple[float, ...], tuple[float, float]]:
        seen = self._published.seen
        if seen is None:
            return {}
        pairs = zip(seen.objects, seen.associations, strict=True)
        return {_key(box): (trunk.x, trunk.y) for box, trunk in pairs if trunk is not None}

    def _trees(self, truth: SimTruth, objects: tuple[DetectedObject, ...]) -> list[int | None]:
        """Which tree each object is, None where that cannot be said or it is far away."""
        rotation = rotation_from_rpy(truth.roll, truth.pitch, truth.yaw)
        pixels = self._camera.project((self._feet - (truth.x, truth.y, 0.0)) @ rotation)
        near = np.hypot(self._feet[:, 0] - truth.x, self._feet[:, 1] - truth.y) <= REACH_M
        return [known_tree(pixels, near, ((o.x1 + o.x2) / 2, o.y2)) for o in objects]

    def _tree_at(self, truth: SimTruth, place: tuple[float, float] | None) -> int | None:
        """The tree at a place in `base_link`, -1 if there is none."""
        if place is None:
            return None
        x, y = SE2(truth.x, truth.y, truth.yaw).apply_point(*place)
        off = np.hypot(self._sections[:, 0] - x, self._sections[:, 1] - y)
        nearest = int(np.nanargmin(off))
        return nearest if off[nearest] < PLACE_M else -1


def _key(box: DetectedObject) -> tuple[float, ...]:
    return box.x1, box.y1, box.x2, box.y2


def known_tree(pixels: Floats, near: NDArray[np.bool_], foot: tuple[float, float]) -> int | None:
    """Which tree an object is whose foot is seen there, by the feet of all trees, (N, 2) pixels.

    None where that cannot be said, or where the tree is none of the `near` ones (N,): a box about a tree further away
    is not one about the near tree before it.
    """
    tree = _nearest(pixels, foot)
    return tree if tree is not None and near[tree] else None


def _nearest(pixels: Floats, foot: tuple[float, float]) -> int | None:
    off = np.hypot(pixels[:, 0] - foot[0], pixels[:, 1] - foot[1])
    order = np.argsort(np.where(np.isnan(off), math.inf, off))[:2]
    if len(order) == 0 or not off[order[0]] < FOOT_PX:
        return None
    return None if len(order) > 1 and off[order[1]] < OTHER_PX else int(order[0])
