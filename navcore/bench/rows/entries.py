"""Entrances seen from outside, the map off by up to 0.8 m: is it the row that was meant, or its neighbour?"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from navcore.bench.rows.placed_robot import in_row, placed
from navcore.bench.rows.valid_frames import PUBLISHED_FILTER
from navcore.geometry.pinhole import PinholeCamera
from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Row
from navcore.messages import CameraName, RowObservation
from navcore.perception.detector import Told
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowMethod, RowPerception, RowPerceptionParams
from navcore.sim.layouts import scoring_layout
from navcore.sim.orchard import OrchardParams
from navcore.sim.planting import build_orchard
from navcore.sim.projected_objects import ProjectedObjects, ProjectedObjectsParams

# Farms of this bench: no mission is scored on them.
FIRST_FARM = 300
# How wrong a drawn row lies at most, m, and how far the robot drives towards it.
MAP_ERROR_M, WAY_M, STEP_M = 0.8, 4.0, 0.06
PRIOR_STD_M = 0.45
# So many pictures in a row have to agree before the camera is trusted.
STREAK = 5


@dataclass(slots=True)
class Entries:
    """How many rows were driven at, in how many of them the camera came to be trusted, and on the row meant."""

    tried: int = 0
    trusted: int = 0
    meant: int = 0


def count_entries(camera: PinholeCamera, method: RowMethod, *, farms: int, entries: int, seed: int) -> Entries:
    """The same approaches for every method of that seed, `entries` on each farm."""
    counts = Entries()
    for farm in range(farms):
        site, rng = scoring_layout(FIRST_FARM + farm), np.random.default_rng((seed, farm))
        detector = ProjectedObjects(
            build_orchard(site, OrchardParams(seed=seed + farm)), camera, ProjectedObjectsParams(), rng
        )
        for _ in range(entries):
            row = site.rows[int(rng.integers(len(site.rows)))]
            width = math.dist(site.rows[0].start, site.rows[1].start)
            off = _approach(row, width, camera, detector, method, np.random.default_rng(rng.integers(2**63)))
            counts.tried += 1
            counts.trusted += off is not None
            counts.meant += off is not None and abs(off) < width / 2
    return counts


def _approach(
    row: Row, width: float, camera: PinholeCamera, detector: ProjectedObjects, method: RowMethod,
    rng: np.random.Generator,
) -> float | None:  # fmt: skip
    """How far from the row that is meant lies the one that the camera came to be trusted on, m; None if on none."""
    given, wrong, streak = Told(), float(rng.uniform(-MAP_ERROR_M, MAP_ERROR_M)), 0
    perception = RowPerception(camera, given, RowPerceptionParams(method=method, filter=PUBLISHED_FILTER))
    image = rng.integers(0, 255, (camera.height_px, camera.width_px, 3), dtype=np.uint8)
    for at in _way_in(rng):
        detector.look_from(placed(in_row(row, at), rng, lean_deg=0.5))
        given.objects = detector.detect(image)
        prior = RowPrior(offset=-at.y + wrong, heading=-at.yaw, std=PRIOR_STD_M, width=width)
        seen = perception.process(image, 0, CameraName.FRONT, prior=prior, motion=SE2(STEP_M, 0.0, 0.0)).row
        streak = streak + 1 if _agrees(seen, prior, width) else 0
        if streak >= STREAK and seen.offset is not None:
            return seen.offset + at.y
    return None


def _way_in(rng: np.random.Generator) -> Iterator[SE2]:
    """Row coordinates of a robot that drives straight at an entrance from 7 m before it."""
    at = SE2(-7.0, float(rng.uniform(-0.6, 0.6)), math.radians(float(rng.uniform(-6.0, 6.0))))
    for _ in range(round(WAY_M / STEP_M)):
        yield at
        at = at @ SE2(STEP_M, 0.0, 0.0)


def _agrees(seen: RowObservation, prior: RowPrior, width: float) -> bool:
    """As the navigator judges: nearer to the expected row than to its neighbours."""
    return seen.valid and seen.offset is not None and abs(seen.offset - prior.offset) < 0.45 * width
