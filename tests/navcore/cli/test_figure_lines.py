"""Figures as a bench prints them."""

from __future__ import annotations

import pytest

from navcore.bench.figure import Figure
from navcore.cli.figure_lines import lines


@pytest.mark.parametrize(
    ("value", "shown"),
    [(12.3456, "12.346"), (0.25, "0.250"), (0.0031234, "0.00312"), (-0.00048, "-0.000480"), (0.0, "0.000")],
)
def test_a_small_figure_is_printed_to_three_digits(value: float, shown: str) -> None:
    figure = Figure(figure="largest error", value=value, unit="m", n=3, seed=None)
    row = lines((figure,), "abc", "a machine").splitlines()[-1]
    assert row.split()[2] == shown
