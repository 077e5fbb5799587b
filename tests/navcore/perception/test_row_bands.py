"""How sure a line is, is seen: its band holds what 95 % of such rows would show, and nothing much wider."""

from __future__ import annotations

import math

import cv2
import numpy as np
import pytest

from navcore.geometry.pinhole import robot_camera
from navcore.messages import ImageArea
from navcore.perception.geometric_filter import GeometricFilterParams, geometric_filter
from navcore.perception.image_lines import image_line
from navcore.perception.row_bands import filter_region, row_bands
from navcore.perception.row_lines import GroundRow

CAMERA = robot_camera()
COVARIANCE = np.array(((0.05**2, -0.3 * 0.05 * 0.01), (-0.3 * 0.05 * 0.01, 0.01**2)))


def row(covariance: np.ndarray = COVARIANCE) -> GroundRow:
    none = np.empty(0)
    return GroundRow(
        offset=0.1, heading=0.03, width=3.0, covariance=covariance, pitch=0.01, left_x=none, right_x=none,
        quality=1.0,
    )  # fmt: skip


def holds(area: ImageArea, u: float, v: float) -> bool:
    return cv2.pointPolygonTest(np.array(area.points, dtype=np.float32), (u, v), measureDist=False) >= 0


@pytest.mark.parametrize(("side", "v"), [(1.0, 230.0), (1.0, 180.0), (-1.0, 230.0), (-1.0, 180.0)])
def test_a_band_holds_19_of_20_rows_that_are_so_uncertain(side: float, v: float) -> None:
    rng, band = np.random.default_rng(2), row_bands(CAMERA, row())[side < 0.0]
    drawn = rng.multivariate_normal((0.1, 0.03), COVARIANCE, 2000)
    lines = [
        image_line(
            CAMERA, offset=offset + side * 1.5 / math.cos(0.03) * math.cos(heading), heading=heading, pitch=0.01
        )
        for offset, heading in drawn
    ]
    inside = np.mean([holds(band, line.x_at(v) or 0.0, v) for line in lines])
    assert 0.93 < inside < 0.97


def test_a_row_known_exactly_has_a_band_as_thin_as_its_line() -> None:
    band, _ = row_bands(CAMERA, row(np.zeros((2, 2))))
    line = image_line(CAMERA, offset=0.1 + 1.5, heading=0.03, pitch=0.01)
    assert all(abs(line.distance(u, v)) < 1.0 for u, v in band.points if v < 300.0)  # px


def test_the_region_is_where_the_geometric_filter_keeps_corner_points() -> None:
    params = GeometricFilterParams(k1=0.3, k2=0.7, k3=0.1, k4=0.9, k5=0.5)
    region = filter_region(params, width_px=640, height_px=360)
    points = np.random.default_rng(1).uniform((0, 0), (640, 360), (500, 2))
    kept = geometric_filter(points, width_px=640, height_px=360, params=params)
    assert [holds(region, u, v) for u, v in points] == kept.tolist()
