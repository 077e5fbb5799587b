"""How much the wheels tell too many, as rows show it."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.localization.wheel_slip import WheelSlip, WheelSlipParams


def driven(slip: WheelSlip, told: float, lost: float) -> float:
    """The share after a row whose end showed so much lost, m."""
    slip.begin()
    slip.drive(told, 0.0)
    slip.lose(lost)
    slip.see_end()
    return slip.share


def test_nothing_is_taken_off_before_a_row_has_told() -> None:
    slip = WheelSlip(WheelSlipParams())
    slip.drive(50.0, 0.0)
    slip.lose(3.0)
    assert slip.share == 0.0


def test_a_long_row_tells_the_slip_and_a_short_way_hardly_does() -> None:
    assert driven(WheelSlip(WheelSlipParams()), 62.0, 2.5) == pytest.approx(0.04, abs=0.004)
    assert driven(WheelSlip(WheelSlipParams()), 4.0, 0.6) < 0.02


def test_rows_that_agree_make_it_surer() -> None:
    slip = WheelSlip(WheelSlipParams())
    for _ in range(4):
        driven(slip, 60.0, 2.4)
    assert driven(slip, 60.0, 4.2) < 0.07  # one row that is drawn too short does not turn it over


@given(st.floats(0.1, 100.0), st.floats(-50.0, 50.0))
def test_wheels_never_tell_too_little_nor_more_than_they_can_slip(told: float, lost: float) -> None:
    assert 0.0 <= driven(WheelSlip(WheelSlipParams()), told, lost) <= WheelSlipParams().most
