"""How far ahead is aimed, by each law."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.control.line_tracker import LineTrackerParams
from navcore.control.look_ahead import (
    AdaptiveLookAheadParams,
    LookAheadParams,
    adaptive_look_ahead,
    gnss_look_ahead,
    published_look_ahead,
    row_look_ahead,
)
from navcore.control.prediction import ActuatorParams
from navcore.control.tracking import TrackerName, TrackingParams, Way, new_tracking


@pytest.mark.parametrize(("v", "metres"), [(0.5, 2.75), (1.0, 5.5), (1.5, 8.25), (0.0, 1.0)])
def test_the_published_look_ahead_is_five_and_a_half_seconds_long(v: float, metres: float) -> None:
    assert published_look_ahead(v) == pytest.approx(metres)


@given(st.floats(0.0, 2.0), st.floats(-1.0, 1.0), st.one_of(st.none(), st.floats(0.0, 2.0)))
def test_ours_is_never_longer_than_on_the_open_straight_and_never_too_short(
    v: float, curvature: float, room: float | None
) -> None:
    p = AdaptiveLookAheadParams()
    assert p.least <= adaptive_look_ahead(v, curvature, room) <= max(adaptive_look_ahead(v, 0.0, None), p.least)


def test_ours_grows_with_the_speed_and_shrinks_in_curves_and_narrow_rows() -> None:
    assert adaptive_look_ahead(1.5, 0.0, None) > adaptive_look_ahead(0.8, 0.0, None)
    assert adaptive_look_ahead(1.5, 1.0 / 1.5, None) < adaptive_look_ahead(1.5, 0.0, None)
    assert adaptive_look_ahead(1.5, 0.0, 0.5) < adaptive_look_ahead(1.5, 0.0, 0.9)


@given(st.floats(0.0, 2.0), st.booleans())
def test_today_s_tracker_aims_as_it_always_has(v: float, in_row: bool) -> None:
    law = LookAheadParams()
    tracking = new_tracking(TrackingParams(name=TrackerName.LINE), LineTrackerParams(), law, ActuatorParams())
    aimed = tracking.look_ahead(Way(v=v, curvature=0.1, in_row=in_row, room=0.4))
    assert aimed == (row_look_ahead(v, law) if in_row else gnss_look_ahead(law))


def test_the_published_law_sees_as_far_as_it_aims() -> None:
    tracking = new_tracking(
        TrackingParams(name=TrackerName.PUBLISHED), LineTrackerParams(), LookAheadParams(), ActuatorParams()
    )
    fastest = Way(v=2.0, curvature=0.0, in_row=False, room=None)
    assert tracking.sight >= tracking.look_ahead(fastest)
