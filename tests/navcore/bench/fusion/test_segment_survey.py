"""Where the middle of a segment is: between its trees."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from navcore.bench.fusion.segment_survey import SegmentSurvey
from navcore.sim.young_orchard import Segment, YoungSegment, tuning_segment

ALONG = np.arange(1.0, 19.0)


def shifted(young: YoungSegment, across: float) -> YoungSegment:
    """The same, but all its trees stand further to the left of where they were meant to stand, m."""
    aside = SegmentSurvey(young).T_row_map.inverse()
    dx, dy = np.array(aside.apply_point(0.0, across)) - np.array(aside.apply_point(0.0, 0.0))
    plants = tuple(replace(p, x=p.x + dx, y=p.y + dy) for p in young.site.plants)
    return replace(young, site=replace(young.site, plants=plants))


@pytest.mark.parametrize("name", list(Segment))
def test_the_middle_goes_where_the_trees_go_and_keeps_its_shape(name: Segment) -> None:
    young = tuning_segment(name, 3)
    before, after = SegmentSurvey(young), SegmentSurvey(shifted(young, 0.1))
    assert after.middle(ALONG) - before.middle(ALONG) == pytest.approx(0.1, abs=1e-9)  # m
    assert after.planned(ALONG) == pytest.approx(before.planned(ALONG))


def test_the_middle_lies_a_few_centimetres_from_where_it_was_meant_to_be() -> None:
    """Of 28 trees that stand 10 cm about their lines."""
    off = [
        SegmentSurvey(young).middle(ALONG) - SegmentSurvey(young).planned(ALONG)
        for young in (tuning_segment(Segment.STRAIGHT, i) for i in range(60))
    ]
    assert np.sqrt(np.mean(np.square(off))) == pytest.approx(0.03, abs=0.01)  # m
