"""A second run updates what is known, and a run that fits in two ways is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from navcore.errors import SiteError
from navcore.mapping.merged_runs import merged
from navcore.maps.trunk_map import MappedTrunk, TrunkMap


def line(places: list[float], prefix: str, std: float = 0.05) -> TrunkMap:
    """Trunks along y = 0 and y = 3."""
    at = [(x, y) for y in (0.0, 3.0) for x in places]
    return TrunkMap(
        trunks=tuple(MappedTrunk(id=f"{prefix}-{k}", x=x, y=y, std=std, diameter=0.1) for k, (x, y) in enumerate(at))
    )


def scattered(seed: int) -> list[float]:
    """About 1.5 m apart, as people plant."""
    return list(map(float, 1.5 * np.arange(20) + np.random.default_rng(seed).normal(0.0, 0.1, 20)))


def moved(trunk_map: TrunkMap, x: float, y: float) -> TrunkMap:
    return TrunkMap(trunks=tuple(replace(t, id="new" + t.id, x=t.x + x, y=t.y + y) for t in trunk_map.trunks))


@given(x=st.floats(-0.35, 0.35), y=st.floats(-0.1, 0.1), seed=st.integers(0, 50))
def test_a_run_shifted_as_a_whole_is_laid_upon_what_is_known(x: float, y: float, seed: int) -> None:
    known = line(scattered(seed), "a")
    both = merged(known, moved(known, x, y))
    assert [t.id for t in both.trunks] == [t.id for t in known.trunks]
    assert all(t.times_seen == 2 for t in both.trunks)
    off = [abs(t.x - k.x) + abs(t.y - k.y) for t, k in zip(both.trunks, known.trunks, strict=True)]
    assert max(off) < 1e-6  # m


def test_new_trunks_are_added_and_unseen_ones_are_kept() -> None:
    places = scattered(1)
    known, seen = line(places[:12], "a"), line(places[6:], "b")
    both = merged(known, seen)
    assert len(both.trunks) == 2 * len(places)
    assert {t.id for t in known.trunks} < {t.id for t in both.trunks}
    assert sorted(t.times_seen for t in both.trunks) == [1] * 28 + [2] * 12


def test_a_run_off_by_half_the_spacing_is_refused() -> None:
    known = line([1.0 * k for k in range(20)], "a", std=0.3)
    with pytest.raises(SiteError, match="in two ways"):
        merged(known, moved(known, 0.5, 0.0))


def test_an_empty_map_becomes_the_runs() -> None:
    seen = line([0.0, 1.5], "a")
    assert merged(TrunkMap(), seen) == seen
    assert merged(seen, TrunkMap()) == seen
