"""A share's interval."""

from __future__ import annotations

import pytest

from navcore.bench.wilson import wilson


def test_wilsons_interval_is_that_of_the_paper() -> None:
    """1570 of 1955 valid frames: 80.31 %."""
    low, high = wilson(1570, 1955)
    assert (low, high) == pytest.approx((0.785, 0.820), abs=0.001)
