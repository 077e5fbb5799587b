"""Rows in rendered pictures by growth stage, through the shipped detector, on farms never seen: paper A's 3.1.4."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.bench.rows.placed_robot import in_row, placed
from navcore.bench.rows.valid_frames import PUBLISHED_FILTER, ROWS
from navcore.geometry.pinhole import PinholeCamera
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, RowObservation
from navcore.perception.detector import Told
from navcore.perception.onnx_detector import OnnxDetector
from navcore.perception.row_perception import RowMethod, RowPerception, RowPerceptionParams
from navcore.sim.camera_light import LightName, named_light
from navcore.sim.camera_renderer import CameraRenderer
from navcore.sim.layouts import scoring_layout
from navcore.sim.orchard import OrchardParams, Season
from navcore.sim.planting import build_orchard

STAGES = (Season.BUDDING, Season.GROWING, Season.MATURING)
LIGHTS = (LightName.NOON, LightName.OVERCAST, LightName.BACKLIT)
# Farms of this bench: no mission is scored on them.
FIRST_FARM = 400
# A centre line is right if the robot on it would be so near to the true one, m and deg.
RIGHT_M, RIGHT_DEG = 0.15, 3.0
# Both row lines are right if the one that is further off lies so near to its row of plants, m.
LINES_M = 0.25
STEP_M = 0.1


@dataclass(slots=True)
class StageCount:
    """Pictures of one stage, and in how many the centre line was right, and both row lines."""

    frames: int = 0
    right: int = 0
    lines: int = 0

    def __add__(self, other: StageCount) -> StageCount:
        return StageCount(self.frames + other.frames, self.right + other.right, self.lines + other.lines)


# By stage, one count for each of the published tables' rows.
StageRows = dict[Season, tuple[StageCount, ...]]


def whole(rows: tuple[StageCount, ...]) -> StageCount:
    """All rows together."""
    return sum(rows, StageCount())


def count_stages(
    camera: PinholeCamera, methods: tuple[RowMethod, ...], *, farms: int, frames: int, seed: int
) -> dict[RowMethod, StageRows]:
    """`frames` pictures that follow each other in a row of each farm, for each stage; lights and rows take turns."""
    counts = {method: {stage: tuple(StageCount() for _ in range(ROWS)) for stage in STAGES} for method in methods}
    detector = OnnxDetector()
    for stage in STAGES:
        for farm in range(farms):
            given = Told()
            perceptions = {method: _perception(camera, given, method) for method in methods}
            for image, truth, width in _drive(camera, stage, farm, frames, seed):
                given.objects = detector.detect(image)
                for method, perception in perceptions.items():
                    row = perception.process(image, 0, CameraName.FRONT, motion=SE2(STEP_M, 0.0, 0.0)).row
                    _count(counts[method][stage][farm % ROWS], row, truth, width)
    return counts


def _perception(camera: PinholeCamera, given: Told, method: RowMethod) -> RowPerception:
    return RowPerception(camera, given, RowPerceptionParams(method=method, filter=PUBLISHED_FILTER))


def _count(count: StageCount, row: RowObservation, truth: SE2, width: float) -> None:
    """`truth` are the row coordinates of the robot, `width` is the corridor's, m."""
    count.frames += 1
    if row.offset is None or row.heading is None:
        return
    beside, along = abs(-row.offset - truth.y), abs(-row.heading - truth.yaw) <= math.radians(RIGHT_DEG)
    count.right += along and beside <= RIGHT_M
    count.lines += along and row.width is not None and beside + abs(row.width - width) / 2 <= LINES_M


def _drive(
    camera: PinholeCamera, stage: Season, farm: int, frames: int, seed: int
) -> Iterator[tuple[NDArray[np.uint8], SE2, float]]:
    """Pictures, where in the row they were taken, and its width, m."""
    site, rng = scoring_layout(FIRST_FARM + farm), np.random.default_rng((seed, farm))
    orchard = build_orchard(site, OrchardParams(season=stage, seed=seed + farm))
    light = named_light(LIGHTS[farm % len(LIGHTS)], along=float(rng.uniform(-math.pi, math.pi)), seed=seed + farm)
    renderer = CameraRenderer(orchard, camera, light)
    row = site.rows[int(rng.integers(len(site.rows)))]
    at = SE2(
        float(rng.uniform(2.0, 40.0)), float(rng.uniform(-0.3, 0.3)), math.radians(float(rng.uniform(-4.0, 4.0)))
    )
    for number in range(frames):
        yield renderer.render(placed(in_row(row, at), rng, lean_deg=0.5), number).image, at, row.width
        at = at @ SE2(STEP_M, 0.0, 0.0)
