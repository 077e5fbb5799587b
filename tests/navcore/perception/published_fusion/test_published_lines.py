"""Paper B's line fits and its smoothing, as published."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.errors import ConfigError, NotFiniteError
from navcore.geometry.line2 import Line2
from navcore.perception.published_fusion.constraint_fit import ConstraintFit, ConstraintFitParams, main_direction
from navcore.perception.published_fusion.point_ransac import PointRansac, PointRansacParams
from navcore.perception.published_fusion.published_rows import mean_line
from navcore.perception.published_fusion.row_kalman import RowKalman, RowKalmanParams

Floats = NDArray[np.float64]

GCA, RANSAC = ConstraintFit(ConstraintFitParams()), PointRansac(PointRansacParams())


def row(heading: float, *, n: int = 15, scatter: float = 0.02, seed: int = 1) -> Floats:
    """Trunks 1 m apart on a line of that heading, 1.2 m to the left of the origin."""
    rng = np.random.default_rng(seed)
    c, s = math.cos(heading), math.sin(heading)
    along, across = np.arange(n, dtype=np.float64), 1.2 + rng.normal(0.0, scatter, n)
    return np.column_stack((c * along - s * across, s * along + c * across))


@pytest.mark.parametrize("heading_deg", [-80.0, -5.0, -0.5, 0.0, 0.5, 5.0, 60.0, 90.0])
def test_the_main_direction_is_the_rows_at_every_heading(heading_deg: float) -> None:
    """0 and 180 deg are one direction, and no edge lies between them."""
    points = row(math.radians(heading_deg))
    main = main_direction(points, np.ones(len(points)), ConstraintFitParams())
    assert main is not None
    assert abs(math.remainder(main.heading - math.radians(heading_deg), math.pi)) < math.radians(1.0)
    assert main.share > 0.4


def test_a_sure_direction_is_held_and_only_the_offset_fitted() -> None:
    points, conf = row(0.03), np.ones(15)
    main, held = main_direction(points, conf, ConstraintFitParams()), GCA.fit(points, conf)
    assert main is not None
    assert held is not None
    assert held.line.heading == pytest.approx(main.heading)
    assert GCA.confidence(points, main, held) == 1.0
    assert held.line.offset == pytest.approx(1.2, abs=0.02)  # m


def test_an_unsure_direction_is_left_to_ransac() -> None:
    points, conf = row(0.03, n=4), np.ones(4)
    held, plain = GCA.fit(points, conf), RANSAC.fit(points, conf)
    assert held is not None
    assert plain is not None
    assert held.line == plain.line


def test_trunks_that_are_believed_less_count_less() -> None:
    crossed = np.vstack((row(0.0, n=8), row(math.pi / 2, n=8)))
    mains = [
        main_direction(crossed, np.repeat(conf, 8), ConstraintFitParams()) for conf in ((0.9, 0.3), (0.3, 0.9))
    ]  # fmt: skip
    assert mains[0] is not None
    assert mains[1] is not None
    assert abs(mains[0].heading) < 0.1
    assert abs(mains[1].heading) > 1.4


def test_ransac_leaves_weeds_out_and_gives_the_same_line_each_time() -> None:
    points = np.vstack((row(-0.04), [(3.0, 2.5), (5.0, 0.2), (8.0, 2.2)]))
    first, second = RANSAC.fit(points, np.ones(18)), RANSAC.fit(points, np.ones(18))
    assert first is not None
    assert second is not None
    assert first.inliers.tolist() == [True] * 15 + [False] * 3
    assert first.line == second.line
    assert first.line.heading == pytest.approx(-0.04, abs=0.005)  # rad


@pytest.mark.parametrize("fitter", [GCA, RANSAC])
def test_too_few_trunks_make_no_line(fitter: ConstraintFit | PointRansac) -> None:
    assert fitter.fit(np.empty((0, 2)), np.empty(0)) is None
    assert fitter.fit(np.zeros((1, 2)), np.ones(1)) is None
    assert fitter.fit(np.zeros((3, 2)), np.ones(3)) is None
    with pytest.raises(NotFiniteError):
        fitter.fit(np.full((3, 2), math.nan), np.ones(3))


def test_values_that_are_none_are_refused() -> None:
    with pytest.raises(ConfigError, match="sigma"):
        ConstraintFitParams(sigma=0.0)
    with pytest.raises(ConfigError, match="RANSAC"):
        PointRansacParams(distance=math.nan)


def test_the_kalman_filter_follows_as_published() -> None:
    """P = R after the first line; then K = (R + Q) / (2 R + Q)."""
    rows = RowKalman(RowKalmanParams())
    rows.update(Line2.along((0.0, 1.0), 0.0))
    line = rows.update(Line2.along((0.0, 2.0), math.atan(0.1)))
    assert line is not None
    assert line.y_at(0.0) == pytest.approx(1.0 + 0.25 / 0.45)  # m
    assert math.tan(line.heading) == pytest.approx(0.1 * 0.11 / 0.21)


def test_a_row_is_kept_for_half_a_second_without_a_line() -> None:
    rows = RowKalman(RowKalmanParams())
    rows.update(Line2.along((0.0, 1.0), 0.0))
    assert [rows.update(None) is not None for _ in range(6)] == [True] * 5 + [False]


def test_a_line_that_runs_across_is_no_row_ahead() -> None:
    assert RowKalman(RowKalmanParams()).update(Line2.along((1.0, 0.0), 1.5)) is None


def test_the_mean_line_has_the_mean_slope_and_intercept() -> None:
    centre = mean_line(Line2.along((0.0, 1.3), math.atan(0.1)), Line2.along((0.0, -1.1), math.atan(-0.04)))
    assert centre is not None
    assert centre.y_at(0.0) == pytest.approx(0.1)  # m
    assert math.tan(centre.heading) == pytest.approx(0.03)
