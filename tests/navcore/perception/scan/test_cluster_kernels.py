"""What makes a thing of a scan a trunk, by the rules told in plain words."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.perception.scan.cluster_kernels import (
    ThingRules,
    TrunkRules,
    expected_rays,
    may_be_trunk,
    ray_step,
    things,
    trunks,
)
from tests.navcore.perception.scan.round_trunks import scan_of

THINGS = ThingRules(near=0.2, far=12.0, jump=0.06, slope=math.radians(12.0), bridge=2, hidden=0.25)
TRUNKS = TrunkRules(
    thinnest=0.03, thickest=0.4, fewest=0.6, rough=2.5, ray_std=0.01, ray_std_share=0.004, cut_std=0.04
)  # fmt: skip


@settings(deadline=None)
@given(st.integers(0, 60), st.integers(0, 10_000))
def test_the_step_between_rays_is_the_median(n: int, seed: int) -> None:
    angles = np.cumsum(np.random.default_rng(seed).uniform(-1.0, 1.0, n))
    expected = float(np.median(np.abs(np.diff(angles)))) if n > 1 else math.radians(0.225)
    assert ray_step(angles) == expected


@settings(deadline=None, max_examples=40)
@given(st.integers(0, 10_000))
def test_trunks_are_the_things_that_are_thick_round_and_met_often_enough(seed: int) -> None:
    rng = np.random.default_rng(seed)
    places = rng.uniform(-6.0, 6.0, (25, 2))
    angles, distances = scan_of(places, rng.choice([0.01, 0.04, 0.1, 0.3, 0.7], 25), noise=0.012, seed=seed)
    step = ray_step(angles)
    found = things(angles, distances, step, THINGS)
    _, rho, radius, rays, rms, first, last, cut = found.T
    noise = np.hypot(0.01, 0.004 * rho)
    thick = (2.0 * radius >= 0.03 - step * rho) & (2.0 * radius <= 0.4 + step * rho)
    enough = rays >= np.maximum(1.0, np.floor(0.6 * expected_rays(0.03, rho, step)))
    good = thick & enough & (rms <= 2.5 * noise)
    assert [may_be_trunk(thing, step, TRUNKS) for thing in found] == good.tolist()
    told = trunks(angles, distances, THINGS, TRUNKS)
    edge, loose = 0.41 * step * rho, np.where(cut > 0, 0.04, 0.0)
    range_std, across = np.sqrt(noise**2 / rays + (0.5 * edge) ** 2 + loose**2), np.hypot(0.5 * edge, loose) / rho
    moment = 0.5 * (first + last) / (len(angles) - 1)
    columns = (
        found[:, 0], rho, range_std, across, 2.0 * radius, np.hypot(edge, loose), cut, rays, moment, rms / noise,
        first, last,
    )  # fmt: skip
    assert told == pytest.approx(np.array(columns)[:, good], abs=1e-15)
