"""Local metres agree with the ellipsoid."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyproj import Geod

from navcore.errors import InputError, NotFiniteError
from navcore.geometry.geodesy import EnuFrame

DATUM = (53.268, -0.524, 55.0)
metres = st.floats(-2000.0, 2000.0)


@given(metres, metres, st.floats(-50.0, 50.0))
def test_there_and_back_is_exact_to_a_tenth_of_a_millimetre(e: float, n: float, u: float) -> None:
    frame = EnuFrame(DATUM)
    assert math.dist(frame.to_enu(*frame.to_geodetic(e, n, u)), (e, n, u)) < 1e-4


@given(st.floats(0.0, 2 * math.pi), st.floats(1.0, 500.0))
def test_metres_are_those_of_the_geodesic(azimuth: float, distance: float) -> None:
    lon, lat, _ = Geod(ellps="WGS84").fwd(DATUM[1], DATUM[0], math.degrees(azimuth), distance)
    e, n, _ = EnuFrame((DATUM[0], DATUM[1], 0.0)).to_enu(lat, lon, 0.0)
    assert math.dist((e, n), (distance * math.sin(azimuth), distance * math.cos(azimuth))) < 1e-3


def test_the_datum_is_the_origin_and_up_is_up() -> None:
    frame = EnuFrame(DATUM)
    assert math.dist(frame.to_enu(*DATUM), (0.0, 0.0, 0.0)) < 1e-6
    assert frame.to_enu(DATUM[0], DATUM[1], 60.0)[2] == pytest.approx(5.0, abs=1e-6)


def test_arrays_are_converted_like_single_points_and_nan_stays_nan() -> None:
    frame = EnuFrame(DATUM)
    lat, lon, h = np.array([53.27, math.nan]), np.array([-0.52, -0.52]), np.array([50.0, 50.0])
    e, n, u = frame.to_enu(lat, lon, h)
    assert (e[0], n[0], u[0]) == pytest.approx(frame.to_enu(53.27, -0.52, 50.0))
    assert np.isnan((e[1], n[1], u[1])).all()


@pytest.mark.parametrize("datum", [(91.0, 0.0, 0.0), (0.0, 181.0, 0.0)])
def test_a_datum_off_the_earth_is_refused(datum: tuple[float, float, float]) -> None:
    with pytest.raises(InputError, match="outside"):
        EnuFrame(datum)


def test_a_datum_without_numbers_is_refused() -> None:
    with pytest.raises(NotFiniteError):
        EnuFrame((math.nan, 0.0, 0.0))
