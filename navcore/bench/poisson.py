"""How sure a rate of rare events is."""

from __future__ import annotations

import math

from scipy.stats import chi2


def poisson_interval(events: int, hours: float, sure: float = 0.95) -> tuple[float, float]:
    """Exact interval of a rate, 1/h (Garwood 1936). Where no event came, all doubt lies above: 3 over the hours."""
    if hours <= 0.0:
        return 0.0, math.inf
    if events == 0:
        return 0.0, -math.log1p(-sure) / hours
    aside = (1.0 - sure) / 2.0
    low, high = chi2.ppf(aside, 2 * events) / 2.0, chi2.ppf(1.0 - aside, 2 * events + 2) / 2.0
    return float(low) / hours, float(high) / hours
