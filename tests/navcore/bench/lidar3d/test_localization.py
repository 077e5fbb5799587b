"""The arithmetic of the localization bench, on drives whose errors are known."""

from __future__ import annotations

import math
from xml.etree import ElementTree

import numpy as np
import pytest

from navcore.bench.lidar3d.error_boxes import HEIGHT_PX, error_boxes
from navcore.bench.lidar3d.fixed_point_figures import at_fixed_points, season_figures
from navcore.bench.lidar3d.localization_drive import Placed
from navcore.bench.lidar3d.trust_figures import trust_figures
from navcore.geometry.se2 import SE2
from navcore.messages import MapMatch, MatchState
from navcore.sim.block_survey import fixed_points
from navcore.sim.orchard import Season
from navcore.sim.pear_block import BlockSize, scoring_block

BLOCK = scoring_block(0, BlockSize(alleys=2, length=12.0))
ROWS = (0, 1)
TURN_NS = 100_000_000
SVG = "{http://www.w3.org/2000/svg}"


def drive(left: float, turned: float) -> list[Placed]:
    """Past every fixed point; all ways are so far off to the left, m, and turned, rad; the map says nothing."""
    points = fixed_points(tuple(BLOCK.site.rows[i] for i in ROWS))
    off = SE2(0.0, left, turned)
    silent = MapMatch(stamp_ns=0, state=MatchState.LOST, reason="lost")
    return [
        Placed(
            stamp_ns=k * TURN_NS, truth=p, rtk=p @ off, fused=p @ off, match=silent, T_odom_base=SE2(), believed=False
        )
        for k, p in enumerate(points)
    ]


def straight(count: int) -> list[Placed]:
    """A robot that drives 0.1 m between matches, all of them right."""
    at = [SE2(0.1 * k, 0.0, 0.0) for k in range(count)]
    return [
        Placed(
            stamp_ns=k * TURN_NS, truth=p, rtk=p, fused=p, T_odom_base=p, believed=True,
            match=MapMatch(stamp_ns=k * TURN_NS, state=MatchState.MATCHED, x=p.x, y=p.y, yaw=p.yaw),
        )
        for k, p in enumerate(at)
    ]  # fmt: skip


def test_an_offset_to_the_left_is_lateral_and_a_turn_is_heading() -> None:
    errors = np.array(at_fixed_points([(BLOCK, drive(0.03, -0.01))], ROWS, "fused"))
    assert errors.shape == (14, 2)
    np.testing.assert_allclose(errors[:, 0], 0.03, atol=1e-9)  # m
    np.testing.assert_allclose(errors[:, 1], -0.01, atol=1e-9)  # rad


def test_a_season_without_matches_has_no_figure_for_the_map_alone() -> None:
    figures = {f.figure: f for f in season_figures("winter", [(BLOCK, drive(0.03, math.radians(0.5)))], ROWS)}
    assert figures["winter: lateral mean at the fixed points"].value == pytest.approx(0.03)  # m
    assert figures["winter: heading mean at the fixed points"].value == pytest.approx(0.5)  # deg
    assert figures["winter: lateral mean at the fixed points"].ok is False
    assert figures["winter: lateral mean, the map alone"].value is None


def test_places_put_wrong_are_noticed() -> None:
    noticed, slowest = trust_figures([straight(200)], count=40)
    assert (noticed.value, noticed.ok) == (1.0, True)
    assert slowest.value is not None
    assert slowest.value <= 0.5  # s


def test_without_a_drive_nothing_is_claimed() -> None:
    noticed, slowest = trust_figures([], count=40)
    assert noticed.value is slowest.value is None


def test_each_way_that_says_something_has_a_box_about_its_errors() -> None:
    drawing = ElementTree.fromstring(error_boxes({Season.DORMANT: [(BLOCK, drive(0.03, math.radians(0.5)))]}, ROWS))
    boxes = [r for r in drawing.iter(f"{SVG}rect") if r.get("fill-opacity")]
    assert len(boxes) == 4  # RTK and both, lateral and heading; the map alone says nothing
    words = [text.text for text in drawing.iter(f"{SVG}text")]
    assert words.count("14") == 4
    assert {"winter", "spring", "full leaf", "RTK alone", "3D map alone"} <= set(words)
    up = {float(box.get("y", "nan")) for box in boxes}
    assert max(up) < HEIGHT_PX / 2.0  # left, and to the left: above the middle


def test_without_any_drive_the_drawing_is_empty_but_whole() -> None:
    drawing = ElementTree.fromstring(error_boxes({}, ROWS))
    assert not [r for r in drawing.iter(f"{SVG}rect") if r.get("fill-opacity")]
