"""Posts of the map that stand there no more are counted as the robot goes past."""

from __future__ import annotations

import numpy as np

from navcore.geometry.se3 import SE3
from navcore.localization.lidar3d.standing_uprights import StandingUprights
from navcore.maps.ndt.ndt_map import NdtMap

SPOTS = [(2.0 * k + 0.25, side) for k in range(12) for side in (-2.75, 2.75)]


def posts(spots: list[tuple[float, float]], seed: int) -> np.ndarray:
    """(N, 3) points of posts 10 cm thick and 1.5 m high."""
    rng = np.random.default_rng(seed)
    feet = np.repeat(np.array(spots), 120, axis=0)
    return np.column_stack((feet + rng.normal(0.0, 0.03, feet.shape), rng.uniform(0.0, 1.5, len(feet))))


def drive(standing: list[tuple[float, float]]) -> StandingUprights:
    """Past all of the map's posts, with those that stand."""
    ndt_map = NdtMap()
    ndt_map.add(posts(SPOTS, 1))
    watch = StandingUprights(ndt_map)
    for k in range(100):
        T_map_base = SE3.from_rpy((0.35 * k - 6.0, 0.1, 0.0), yaw=0.05)
        watch.add(T_map_base.inverse().apply(posts(standing, k)), T_map_base)
    return watch


def test_posts_that_stand_are_all_found() -> None:
    watch = drive(SPOTS)
    assert watch.passed >= len(SPOTS)  # more than one cell of each is looked for
    assert watch.gone == 0


def test_half_of_the_posts_gone_is_counted_as_half() -> None:
    watch = drive(SPOTS[::2])
    assert 0.4 < watch.gone / watch.passed < 0.6


def test_a_map_without_uprights_is_never_old() -> None:
    rng = np.random.default_rng(3)
    ground = NdtMap()
    ground.add(np.column_stack((rng.uniform(-9.0, 9.0, (5000, 2)), rng.normal(0.0, 0.02, 5000))))
    watch = StandingUprights(ground)
    watch.add(np.zeros((10, 3)), SE3.identity())
    assert (watch.passed, watch.gone) == (0, 0)
