"""The ground is bare under the plants, a road where the lane runs, and takes the orthophoto's colours."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.sim.render.ground import CELL_M, GRASS, ROAD, SOIL, away, cover, nearest, tinted


def test_a_road_wins_over_everything() -> None:
    assert cover(-0.1, 0.0, 1.5, 0.0, 1.0, 0.5, 0.5, 0.5) == ROAD


def test_the_strip_under_the_plants_is_bare() -> None:
    assert cover(9.0, 0.1, 1.5, 0.0, 1.0, 0.5, 0.5, 0.5) == SOIL


def test_the_alley_is_grass_on_a_grassy_farm_and_bare_on_a_dry_one() -> None:
    assert cover(9.0, 0.6, 1.5, 0.0, 1.0, 0.5, 0.5, 0.5) == GRASS
    assert cover(9.0, 0.6, 1.5, 0.0, 0.0, 0.5, 0.5, 0.5) == SOIL


@given(x=st.floats(-20, 20), y=st.floats(-20, 20), angle=st.floats(-3, 3))
def test_distance_from_a_stretch_is_zero_on_it_and_never_less_than_sideways(x: float, y: float, angle: float) -> None:
    c, s = float(np.cos(angle)), float(np.sin(angle))
    assert away(1.0, 2.0, c, s, 10.0, 1.0 + 5 * c, 2.0 + 5 * s)[0] == pytest.approx(0.0, abs=1e-9)
    assert away(1.0, 2.0, c, s, 10.0, x, y)[0] >= abs((y - 2.0) * c - (x - 1.0) * s) - 1e-9


def test_each_cell_knows_its_nearest_stretch() -> None:
    stretches = np.array([(0.0, 0.0, 1.0, 0.0, 20.0, 1.5), (0.0, 4.0, 1.0, 0.0, 20.0, 1.5)])
    index = nearest(stretches, -10.0, -10.0, 60, 80)
    assert index[int((0.7 + 10) / CELL_M), int((5 + 10) / CELL_M)] == 0
    assert index[int((3.3 + 10) / CELL_M), int((5 + 10) / CELL_M)] == 1
    assert index[int((-9.0 + 10) / CELL_M), int((5 + 10) / CELL_M)] == -1


def test_the_orthophoto_draws_colours_towards_its_own() -> None:
    assert 60.0 < tinted(60.0, 160, 1.0) < 160.0
    assert tinted(250.0, 255, 2.0) == 255.0
