"""Trunks are found in the order of the rays, with centre and diameter, from 0.5 m to as far as the sensor sees."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.perception.scan.cluster_kernels import expected_rays
from navcore.perception.scan.scan_clusters import ScanClusters
from tests.navcore.perception.scan.round_trunks import scan_of


def at(*polar: tuple[float, float]) -> np.ndarray:
    """Places of (bearing deg, range m)."""
    return np.array([(r * np.cos(np.radians(b)), r * np.sin(np.radians(b))) for b, r in polar])


@given(bearing=st.floats(-170.0, -10.0), reach=st.floats(0.6, 8.0), diameter=st.floats(0.05, 0.15))
@settings(max_examples=200, deadline=None)
def test_a_trunk_has_its_centre_and_diameter(bearing: float, reach: float, diameter: float) -> None:
    angles, distances = scan_of(at((bearing, reach)), np.array([diameter]))
    found = ScanClusters().find(angles, distances)
    assert len(found) == 1
    ray = reach * 2.0 * np.pi / len(angles)  # m between two rays at that range
    assert found.diameter[0] == pytest.approx(diameter, abs=1.3 * ray)
    # Half a ray at the edges, more where two rays are all, and how far a circle curves back under grazing ones, m.
    assert found.range[0] == pytest.approx(reach, abs=0.65 * ray + 0.15 * diameter)
    off = (np.degrees(found.bearing[0]) - bearing + 180.0) % 360.0 - 180.0
    assert abs(off) <= 0.5 * 0.225 + 1e-6  # deg


def test_a_trunks_diameter_at_one_and_a_half_metres_is_known_to_a_centimetre() -> None:
    rng, errors = np.random.default_rng(3), []
    for i in range(300):
        diameter = rng.uniform(0.05, 0.15)
        angles, distances = scan_of(at((rng.uniform(-175, -5), 1.5)), np.array([diameter]), noise=0.01, seed=i)
        found = ScanClusters().find(angles, distances)
        errors.append(found.diameter[np.argmin(np.abs(found.range - 1.5))] - diameter)
    assert np.percentile(np.abs(errors), 95) < 0.01  # m


def test_how_certain_a_centre_is_told_is_how_far_off_it_is() -> None:
    rng, off = np.random.default_rng(4), []
    for i in range(400):
        reach, bearing = rng.uniform(0.8, 8.0), rng.uniform(-175, -5)
        angles, distances = scan_of(at((bearing, reach)), np.array([0.1]), noise=0.01, seed=i)
        found = ScanClusters().find(angles, distances)
        if len(found) == 1:
            off.append((found.range[0] - reach) / found.range_std[0])
    assert len(off) > 380
    assert 0.5 < np.std(off) < 1.5  # 1-sigma
    assert abs(np.mean(off)) < 0.4  # 1-sigma


def test_a_trunk_that_the_turn_begins_and_ends_on_is_told_as_cut() -> None:
    found = ScanClusters().find(*scan_of(at((0.0, 1.0)), np.array([0.1])))
    assert len(found) == 2
    assert found.cut.all()


def test_far_trunks_of_a_single_ray_count_and_near_ones_do_not() -> None:
    far, near = scan_of(at((-90.0, 10.5)), np.array([0.05])), scan_of(at((-90.0, 1.0)), np.array([0.005]))
    assert len(ScanClusters().find(*far)) == 1
    assert len(ScanClusters().find(*near)) == 0


def test_two_trunks_one_behind_the_other_are_two() -> None:
    angles, distances = scan_of(at((-90.0, 2.0), (-88.0, 3.0)), np.array([0.1, 0.12]))
    found = ScanClusters().find(angles, distances)
    assert len(found) == 2
    behind = int(np.argmax(found.range))
    assert found.cut[behind]
    assert not found.cut[1 - behind]
    assert found.range_std[behind] > 2.0 * found.range_std[1 - behind]


def test_walls_and_things_too_thick_are_no_trunks() -> None:
    angles = -np.arange(1600, dtype=np.float64) * (2.0 * np.pi / 1600)
    with np.errstate(divide="ignore"):
        wall = np.where(np.sin(angles) < -0.3, -1.5 / np.sin(angles), 0.0)
    assert len(ScanClusters().find(angles, wall)) == 0
    assert len(ScanClusters().find(*scan_of(at((-60.0, 3.0)), np.array([0.8])))) == 0


def test_a_ragged_bunch_is_no_trunk() -> None:
    angles, distances = scan_of(at((-60.0, 2.0)), np.array([0.25]))
    rng = np.random.default_rng(1)
    ragged = np.where(distances > 0, distances + rng.uniform(-0.06, 0.06, len(distances)), 0.0)
    assert np.all(ScanClusters().find(angles, ragged).diameter < 0.2)


def test_a_trunk_with_missing_rays_is_still_one() -> None:
    angles, distances = scan_of(at((-60.0, 1.5)), np.array([0.12]))
    hit = np.flatnonzero(distances)
    distances[hit[[3, 7, 8]]] = 0.0
    found = ScanClusters().find(angles, distances)
    assert len(found) == 1
    assert found.diameter[0] == pytest.approx(0.12, abs=0.012)  # m


def test_a_scan_of_nothing_has_no_trunks() -> None:
    assert len(ScanClusters().find(np.zeros(0), np.zeros(0))) == 0
    angles = -np.arange(1600, dtype=np.float64) * 0.004
    assert len(ScanClusters().find(angles, np.zeros(1600))) == 0


def test_as_many_rays_as_paper_b_expects() -> None:
    ranges = np.array([1.0, 2.0, 4.0])
    assert expected_rays(0.1, ranges, np.radians(0.225)) == pytest.approx(360 * 0.1 / (2 * np.pi * ranges * 0.225))


def test_the_rays_that_met_a_trunk_are_told() -> None:
    angles, distances = scan_of(at((-60.0, 1.5), (40.0, 3.0)), np.array([0.12, 0.1]))
    found = ScanClusters().find(angles, distances)
    met = np.concatenate([np.arange(a, b + 1) for a, b in zip(found.first, found.last, strict=True)])
    assert sorted(met) == np.flatnonzero(distances).tolist()


def test_columns_of_a_table_are_a_scan_as_good_as_any() -> None:
    angles, distances = scan_of(at((-60.0, 1.5)), np.array((0.1,)))
    table = np.column_stack((angles, distances))
    assert len(ScanClusters().find(table[:, 0], table[:, 1])) == 1
