"""A leaning camera: what it sees, and what it would have seen upright."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.geometry.pinhole import robot_camera, rotation_from_rpy
from navcore.perception.levelling import leaning_exactly, leaning_offset, leaning_plants, level_plants, upright_offset
from navcore.perception.plants.scanned_plants import ScannedPlants

HEIGHT = 0.8
offsets, rolls = st.floats(-0.5, 0.5), st.floats(-0.05, 0.05)


@given(offsets, rolls)
def test_levelling_undoes_leaning(offset: float, roll: float) -> None:
    seen = leaning_offset(offset, 3.0, HEIGHT, roll)
    # The width is seen changed too; both directions use the true one here.
    assert upright_offset(seen, 3.0, HEIGHT, roll) == pytest.approx(offset, abs=0.03)  # m


@given(offsets, rolls)
def test_what_a_leaning_camera_is_told_to_have_seen_levels_to_what_was_scanned(offset: float, roll: float) -> None:
    told = leaning_exactly(offset, 3.0, HEIGHT, roll)
    assert upright_offset(told, 3.0, HEIGHT, roll) == pytest.approx(offset, abs=0.001)  # m


def test_an_upright_camera_needs_no_correction() -> None:
    assert upright_offset(0.3, 3.0, HEIGHT, 0.0) == pytest.approx(0.3, abs=1e-12)


@pytest.mark.parametrize("roll", [math.radians(3.0), math.radians(-3.0)])
def test_levelling_agrees_with_projection_through_a_leaning_camera(roll: float) -> None:
    """Ground points of a corridor 0.2 m left of the robot, projected by a leaning body, read by an upright one."""
    camera = robot_camera()
    x = np.linspace(4.0, 8.0, 20)
    seen = []
    for side in (1.7, -1.3):
        points = np.column_stack((x, np.full_like(x, side), np.zeros_like(x)))
        leaning = points @ rotation_from_rpy(roll, 0.0, 0.0)
        ground = camera.ground(camera.project(leaning))
        seen.append(np.polyfit(ground[:, 0], ground[:, 1], 1)[1])
    offset, width = (seen[0] + seen[1]) / 2, seen[0] - seen[1]
    assert abs(offset - 0.2) > 0.1  # m: leaning matters
    assert upright_offset(offset, width, HEIGHT, roll) == pytest.approx(0.2, abs=0.02)  # m


@pytest.mark.parametrize("slope_deg", [8.0, -8.0])
def test_on_a_side_slope_plants_grow_upright_and_are_scanned_uphill_of_their_feet(slope_deg: float) -> None:
    """The robot stands level on the land, which rises to its left; the scan is 0.55 m above it."""
    rise, feet = math.tan(math.radians(slope_deg)), np.array(((3.0, 1.2), (4.0, -1.3)))
    scanned = ScannedPlants(
        number=np.arange(2), xy=feet + np.array((0.0, 0.55 * rise)), std=np.full(2, 0.01), diameter=np.full(2, 0.1),
        hits=np.full(2, 9), sureness=np.ones(2), height=0.55,
    )  # fmt: skip
    found = leaning_plants(scanned, HEIGHT, roll=0.0, land_roll=math.radians(slope_deg))
    assert found.xy == pytest.approx(feet, abs=1e-9)  # m
    assert abs(leaning_plants(scanned, HEIGHT, roll=0.0).xy[0, 1] - 1.2) > 0.07  # m


@given(rolls, st.floats(-0.14, 0.14))
def test_plants_scanned_from_a_leaning_body_are_put_back_onto_their_feet(roll: float, land_roll: float) -> None:
    """The scan is 0.55 m above the ground: lean carries it to the right, sloping land the trunks to its left."""
    feet, aside = np.array(((3.0, 1.2), (4.0, -4.3))), np.array((0.0, 0.55 * (math.sin(roll) + math.tan(land_roll))))
    scanned = ScannedPlants(
        number=np.arange(2), xy=feet + aside, std=np.full(2, 0.01),
        diameter=np.full(2, 0.1), hits=np.full(2, 9), sureness=np.ones(2), height=0.55,
    )  # fmt: skip
    assert level_plants(scanned, roll, land_roll).xy == pytest.approx(feet, abs=1e-9)  # m
