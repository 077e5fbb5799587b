"""Of two places the one that fits better nearly everywhere leads; a place never leads itself."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.geometry.se3 import SE3
from navcore.localization.lidar3d.contest import Contest, Hypothesis
from navcore.localization.ndt.ndt_matcher import NdtMatcher, NdtMatcherParams
from navcore.localization.ndt.start_search import StartSearchParams
from navcore.maps.ndt.ndt_map import NdtMap
from tests.navcore.localization.ndt.trellis import mapped_orchard, scan_at

HERE = SE3.from_rpy((0.4, 0.2, 0.0), 0.0, 0.0, 0.03)
NOWHERE = NdtMatcherParams(search=StartSearchParams(reach=0.0, turn=0.0))


@pytest.fixture(scope="module")
def orchard_map() -> NdtMap:
    return mapped_orchard()


def contest(orchard_map: NdtMap, *along: float) -> Contest:
    """Places so far along the row from the true one, m, after one look."""
    matcher = NdtMatcher(orchard_map, NOWHERE)
    result = Contest(orchard_map, matcher)
    points = scan_at(HERE, 1, n=16_000)
    for way in along:
        result.enter(
            matcher.match(points, SE3(HERE.R, HERE.t + np.array((way, 0.0, 0.0)))), SE3.identity(), meant=True
        )
    result.thin_out()
    result.look(points, SE3.identity())
    return result


def away(place: Hypothesis) -> float:
    return float(np.hypot(*(place.found.T_target_source.t - HERE.t)[:2]))


def test_the_true_place_leads_the_next_post_by_far(orchard_map: NdtMap) -> None:
    first, *others = contest(orchard_map, 3.0, 0.0, -3.0, 6.0).places
    result = contest(orchard_map, 3.0, 0.0, -3.0, 6.0)
    assert away(first) < 0.05  # m
    assert len(others) >= 2
    assert all(result.lead(result.places[0], other) > 8.0 for other in result.places[1:])


def test_a_lead_is_what_the_other_lacks(orchard_map: NdtMap) -> None:
    result = contest(orchard_map, 3.0, 0.0, -3.0)
    for one in result.places:
        assert result.lead(one, one) == 0.0
        for other in result.places:
            assert result.lead(one, other) == pytest.approx(-result.lead(other, one))


def test_places_that_slide_together_are_one(orchard_map: NdtMap) -> None:
    assert len(contest(orchard_map, 0.0, 0.1, -0.1).places) == 1


def test_from_one_place_more_looks_weigh_no_more(orchard_map: NdtMap) -> None:
    result = contest(orchard_map, 3.0, 0.0)
    once = result.lead(*result.places[:2])
    for _ in range(5):
        result.look(scan_at(HERE, 1, n=16_000), SE3.identity())
    assert result.lead(*result.places[:2]) == pytest.approx(once, rel=0.05)
