"""The axis of an upright from the rays that met it, also where they all came from one side.

Posts are 3 to 7.5 cm in radius; thicker ones are pulled towards that, by 13 mm at 9 cm.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.mapping.trellis.axis_fit import fit_axis


def met_from_one_side(radius: float, bearing: float, seed: int = 0) -> tuple[np.ndarray, np.ndarray]:
    """Hits on an upright at the origin, seen from 2 to 6 m away while driving past it; z is the height."""
    rng = np.random.default_rng(seed)
    along, u = rng.uniform(-4.0, 4.0, 600), rng.uniform(-1.0, 1.0, (600, 1))
    c, s = math.cos(bearing), math.sin(bearing)
    origins = np.column_stack((along, np.full(600, 3.0))) @ np.array(((c, s), (-s, c)))
    away = origins / np.linalg.norm(origins, axis=1, keepdims=True)
    across = np.column_stack((-away[:, 1], away[:, 0]))
    hits = radius * (u * across + np.sqrt(1.0 - u * u) * away) + rng.normal(0.0, 0.01, (600, 2))
    z = rng.uniform(0.3, 0.9, 600)
    return np.column_stack((hits, z)), np.column_stack((origins, np.full(600, 0.9)))


@settings(max_examples=20, deadline=None)
@given(st.floats(0.03, 0.075), st.floats(-3.1, 3.1))
def test_an_upright_seen_from_one_side_stands_where_it_stands(radius: float, bearing: float) -> None:
    axis = fit_axis(*met_from_one_side(radius, bearing))
    assert math.hypot(*axis.at(0.6)) < 0.012  # m
    assert axis.radius == pytest.approx(radius, abs=0.012)  # m


def test_without_rays_it_seems_to_stand_nearer_to_the_sensor() -> None:
    points, _ = met_from_one_side(0.06, 0.0)
    blind = fit_axis(points, None)
    assert math.hypot(*blind.at(0.6)) > 0.02  # m
    assert blind.radius == 0.0
