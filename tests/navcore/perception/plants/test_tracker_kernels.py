"""The tracker's compiled arithmetic is the plain rule, array by array."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2
from navcore.perception.plants.alignment_kernels import mutual_nearest
from navcore.perception.plants.tracker_kernels import among, in_base, kept, meet

seeds, counts = st.integers(0, 10_000), st.integers(0, 12)


@settings(deadline=None)
@given(seeds, counts)
def test_a_trunk_stands_where_the_mount_and_the_way_since_it_was_met_put_it(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    mount = LidarMount(x=0.3, y=-0.1, z=0.5, roll=rng.uniform(-3.1, 3.1), pitch=0.1, yaw=rng.uniform(-3.0, 3.0))
    bearing, reach, moment = rng.uniform(-3.0, 3.0, n), rng.uniform(0.2, 12.0, n), rng.uniform(0.0, 1.0, n)
    turn = SE2(*rng.uniform(-0.2, 0.2, 3))
    axes = np.ascontiguousarray(mount.R_base_lidar()[:2, :2])
    told = in_base(bearing, reach, moment, axes, (mount.x, mount.y), (turn.x, turn.y, turn.yaw))
    then = mount.ends(bearing, reach)[:, :2]
    assert told.shape == (n, 2)
    for place, before, early in zip(told, then, 1.0 - moment, strict=True):
        at = SE2(0.0, 0.0, -early * turn.yaw).apply_point(before[0] - early * turn.x, before[1] - early * turn.y)
        assert place == pytest.approx(at, abs=1e-12)  # m


@settings(deadline=None)
@given(seeds, counts, counts)
def test_a_known_trunk_moves_its_plant_by_a_kalman_step_and_an_unknown_one_none(seed: int, n: int, m: int) -> None:
    rng = np.random.default_rng(seed)
    xy, std, diameter, weight = rng.uniform(0.0, 1.0, (n, 2)), *rng.uniform(0.01, 0.1, (3, n))
    at, at_std, thick, measured = rng.uniform(0.0, 1.0, (m, 2)), *rng.uniform(0.01, 0.1, (3, m))
    hits, since = rng.integers(1, 9, m), rng.integers(0, 9, m)
    plants = at.copy(), at_std.copy(), thick.copy(), measured.copy(), hits.copy(), since.copy()
    mine, theirs, new = meet((xy, std, diameter, weight), plants, 0.2, 0.002, 0.008)
    pairs = mutual_nearest(xy, at, 0.2)
    assert (mine.tolist(), theirs.tolist()) == (pairs[0].tolist(), pairs[1].tolist())
    assert new.tolist() == [k for k in range(n) if k not in set(mine.tolist())]
    gain, share = np.zeros(m), np.zeros(m)
    variance = at_std**2 + 0.002**2
    gain[theirs] = variance[theirs] / (variance[theirs] + std[mine] ** 2)
    share[theirs] = weight[mine] / (measured[theirs] + weight[mine])
    seen, seen_diameter = at.copy(), thick.copy()
    seen[theirs], seen_diameter[theirs] = xy[mine], diameter[mine]
    met = np.isin(np.arange(m), theirs)
    assert plants[0] == pytest.approx(at + gain[:, None] * (seen - at), abs=1e-15)
    assert plants[1] == pytest.approx(
        np.where(met, np.maximum(np.sqrt((1.0 - gain) * variance), 0.008), at_std), abs=1e-15
    )  # fmt: skip
    assert plants[2] == pytest.approx(thick + share * (seen_diameter - thick), abs=1e-15)
    assert plants[4].tolist() == (hits + met).tolist()
    assert plants[5].tolist() == np.where(met, 0, since + 1).tolist()


@settings(deadline=None)
@given(seeds, counts)
def test_what_is_far_away_or_fleeting_is_not_kept(seed: int, n: int) -> None:
    rng = np.random.default_rng(seed)
    xy, hits, since = rng.uniform(-2.0, 2.0, (n, 2)), rng.integers(1, 6, n), rng.integers(0, 8, n)
    near = np.hypot(xy[:, 0] - 0.5, xy[:, 1] + 0.2) <= 1.5
    expected = near & ~((hits < 3) & (since > 4))
    assert kept(xy, hits, since, (0.5, -0.2), 1.5, 3, 4).tolist() == expected.tolist()


@settings(deadline=None)
@given(st.lists(st.integers(0, 20)), st.lists(st.integers(0, 20), max_size=6))
def test_numbers_are_found_among_those_told(numbers: list[int], told: list[int]) -> None:
    found = among(np.array(numbers, dtype=np.int64), np.array(told, dtype=np.int64))
    assert found.tolist() == [number in told for number in numbers]
