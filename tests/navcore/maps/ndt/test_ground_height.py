"""The ground under a place on a map, below what stands on it."""

from __future__ import annotations

import numpy as np
import pytest

from navcore.maps.ndt.ground_height import ground_height
from navcore.maps.ndt.ndt_map import NdtMap


def test_the_ground_is_found_under_trees_and_posts() -> None:
    rng = np.random.default_rng(3)
    x, y = rng.uniform(-20.0, 20.0, (2, 20_000))
    ground = np.column_stack((x, y, 0.05 * x + rng.normal(0.0, 0.02, len(x))))
    trees = np.column_stack((x[:5000], np.round(y[:5000] / 3.0) * 3.0, rng.uniform(0.3, 3.0, 5000)))
    ndt_map = NdtMap()
    ndt_map.add(np.concatenate((ground, trees)))
    for place in ((0.0, 0.0), (10.0, 5.0), (-10.0, -5.0)):
        assert ground_height(ndt_map, *place) == pytest.approx(0.05 * place[0], abs=0.25)  # m: it slopes within reach


def test_where_the_map_has_nothing_the_ground_lies_at_its_zero() -> None:
    assert ground_height(NdtMap(), 5.0, 5.0) == 0.0
