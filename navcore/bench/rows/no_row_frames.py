"""Places without a row ahead, on farms never tuned on: what is called a row there is invented."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from navcore.bench.rows.placed_robot import in_row, placed
from navcore.bench.rows.valid_frames import PUBLISHED_FILTER
from navcore.geometry.pinhole import PinholeCamera
from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Row, SiteMap
from navcore.messages import CameraName, DetectedObject
from navcore.perception.detector import Told
from navcore.perception.row_perception import RowMethod, RowPerception, RowPerceptionParams
from navcore.sim.layouts import scoring_layout
from navcore.sim.orchard import OrchardParams
from navcore.sim.planting import build_orchard
from navcore.sim.projected_objects import ProjectedObjects, ProjectedObjectsParams

# Farms of this bench: no mission is scored on them.
FIRST_FARM = 200


class NoRow(StrEnum):
    """HEADLAND: along the rows' ends. TURNING: before them, turned by 35 to 75 deg. ROAD: away from the rows.
    SINGLE_ROW: beside the outermost line of plants.
    """

    HEADLAND = "headland"
    TURNING = "turning"
    ROAD = "road"
    SINGLE_ROW = "single row"


@dataclass(slots=True)
class FalseLines:
    """Frames of one kind, and in how many a row was seen."""

    frames: int = 0
    seen: int = 0


def count_false_lines(
    camera: PinholeCamera, methods: tuple[RowMethod, ...], *, farms: int, frames: int, seed: int
) -> dict[RowMethod, dict[NoRow, FalseLines]]:
    """Single pictures, nothing known beside them; `frames` of each kind on each farm."""
    counts = {method: {kind: FalseLines() for kind in NoRow} for method in methods}
    image = np.random.default_rng(0).integers(0, 255, (camera.height_px, camera.width_px, 3), dtype=np.uint8)
    for kind, objects in _views(camera, farms=farms, frames=frames, seed=seed):
        for method in methods:
            params = RowPerceptionParams(method=method, filter=PUBLISHED_FILTER)
            seen = RowPerception(camera, Told(objects), params).process(image, 0, CameraName.FRONT)
            count = counts[method][kind]
            count.frames, count.seen = count.frames + 1, count.seen + seen.row.valid
    return counts


def _views(
    camera: PinholeCamera, *, farms: int, frames: int, seed: int
) -> Iterator[tuple[NoRow, tuple[DetectedObject, ...]]]:
    nothing = np.empty((0, 0, 3), dtype=np.uint8)
    for farm in range(farms):
        site, rng = scoring_layout(FIRST_FARM + farm), np.random.default_rng((seed, farm))
        orchard = build_orchard(site, OrchardParams(seed=seed + farm))
        detector = ProjectedObjects(orchard, camera, ProjectedObjectsParams(), rng)
        for kind in NoRow:
            for _ in range(frames):
                detector.look_from(placed(_place(site, kind, rng), rng, lean_deg=0.7))
                yield kind, detector.detect(nothing)


def _place(site: SiteMap, kind: NoRow, rng: np.random.Generator) -> SE2:
    if kind is NoRow.SINGLE_ROW:
        return _beside(site, rng)
    row = site.rows[int(rng.integers(len(site.rows)))]
    out, turn = _before_end(row, rng), float(rng.choice((-1.0, 1.0)))
    if kind is NoRow.HEADLAND:
        return out @ SE2(0.0, 0.0, turn * math.pi / 2 + math.radians(rng.uniform(-12.0, 12.0)))
    if kind is NoRow.TURNING:
        return out @ SE2(0.0, 0.0, math.pi + turn * math.radians(rng.uniform(35.0, 75.0)))
    return out @ SE2(0.0, 0.0, math.radians(rng.uniform(-30.0, 30.0)))


def _before_end(row: Row, rng: np.random.Generator) -> SE2:
    """2 to 5 m before one end of a row, looking away from it."""
    ends = (row.start, row.end) if rng.random() < 0.5 else (row.end, row.start)
    heading = math.atan2(ends[0][1] - ends[1][1], ends[0][0] - ends[1][0])
    return SE2(*ends[0], heading) @ SE2(float(rng.uniform(2.0, 5.0)), float(rng.uniform(-1.0, 1.0)), 0.0)


def _beside(site: SiteMap, rng: np.random.Generator) -> SE2:
    """Outside the block, 1 to 2 m beside its first line of plants and along it, all plants on one side."""
    row, inward = site.rows[0], site.rows[1]
    along = in_row(row, SE2())
    side = math.copysign(1.0, along.inverse().apply_point(*inward.start)[1])
    width = abs(along.inverse().apply_point(*inward.start)[1])
    at = along @ SE2(float(rng.uniform(5.0, 40.0)), -side * (width / 2 + float(rng.uniform(1.0, 2.0))), 0.0)
    return at @ SE2(0.0, 0.0, math.radians(rng.uniform(-5.0, 5.0)))
