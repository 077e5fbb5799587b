"""How well the row's end is seen: its distance, told by a camera that nods on rough ground, 5 m before it."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from navcore.bench.rows.recorded_rows import RecordedFrame, RecordedRowsParams, record_rows
from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import CameraName
from navcore.perception.detector import Told
from navcore.perception.row_lines import RowPrior
from navcore.perception.row_perception import RowPerception, RowPerceptionParams

AT_M = 5.0
# 1-sigma of the pitch so that nearly all of it lies within the 2 deg that are asked for.
PITCH_DEG = 1.0
# 1-sigma of what the IMU tells of it, deg.
IMU_DEG = 0.3


def end_errors(camera: PinholeCamera, *, drives: int, seed: int) -> NDArray[np.float64]:
    """Told less true distance (N,), m, one a drive; NaN where no end is told by then."""
    params = RecordedRowsParams(frames=260, length=18.0, spacing=1.2, pitch_deg=PITCH_DEG)
    return np.array([_error(camera, params, np.random.default_rng((seed, drive))) for drive in range(drives)])


def _error(camera: PinholeCamera, params: RecordedRowsParams, rng: np.random.Generator) -> float:
    given = Told()
    perception = RowPerception(camera, given, RowPerceptionParams())
    image = rng.integers(0, 255, (camera.height_px, camera.width_px, 3), dtype=np.uint8)
    for frame in record_rows(camera, params, rng):
        given.objects = frame.objects
        prior = _prior(frame, rng)
        row = perception.process(image, 0, CameraName.FRONT, prior=prior, motion=frame.motion).row
        if frame.to_end <= AT_M:
            return row.end_distance - frame.to_end if row.end_distance is not None else math.nan
    return math.nan


def _prior(frame: RecordedFrame, rng: np.random.Generator) -> RowPrior:
    """As the navigator has it in the row: the line to a decimetre, and the pitch by the IMU."""
    return RowPrior(
        offset=frame.offset + float(rng.normal(0.0, 0.05)), heading=frame.heading + float(rng.normal(0.0, 0.01)),
        std=0.15, width=frame.width, pitch=frame.pitch + math.radians(float(rng.normal(0.0, IMU_DEG))),
    )  # fmt: skip
