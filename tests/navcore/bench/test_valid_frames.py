"""The difficulty of the recorded rows, and the measure that paper A used."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.bench.recorded_rows import RecordedRowsParams, record_rows
from navcore.bench.valid_frames import valid_rate, wilson
from navcore.geometry.pinhole import robot_camera
from navcore.perception.row_perception import RowMethod

CAMERA = robot_camera()


def test_wilsons_interval_is_that_of_the_paper() -> None:
    """1570 of 1955 valid frames: 80.31 %."""
    low, high = wilson(1570, 1955)
    assert (low, high) == pytest.approx((0.785, 0.820), abs=0.001)


def test_the_same_seed_records_the_same_rows() -> None:
    once, again = (record_rows(CAMERA, RecordedRowsParams(frames=10), np.random.default_rng(5)) for _ in range(2))
    assert once == again


def test_the_published_fits_rank_as_published() -> None:
    """Set once: about 80, 92 and 97 % (here with 400 frames, so within three points or so)."""
    rates = {m: valid_rate(m, CAMERA, drives=2, seed=1).rate for m in RowMethod}
    assert rates[RowMethod.LEAST_SQUARES] == pytest.approx(0.82, abs=0.06)
    assert rates[RowMethod.RANSAC] == pytest.approx(0.91, abs=0.05)
    assert rates[RowMethod.TEMPORAL_RANSAC] == pytest.approx(0.965, abs=0.03)
    assert rates[RowMethod.LEAST_SQUARES] < rates[RowMethod.RANSAC] < rates[RowMethod.TEMPORAL_RANSAC]


def test_without_faults_every_frame_is_valid() -> None:
    clean = RecordedRowsParams(
        frames=40, drop_out=0.0, burst=0.0, false_boxes=0.0, edge_px=0.0, foot_lift=0.0, scatter=0.0, pitch_deg=0.0
    )
    assert valid_rate(RowMethod.CORRIDOR, CAMERA, drives=1, seed=1, rows=clean).rate == 1.0
