"""The trellis reference: posts, trunks and lines of a block from one run or several, whatever grows in between."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import KDTree

from navcore.errors import CloudError
from navcore.mapping.trellis.ground_model import GroundModel
from navcore.mapping.trellis.seen_cloud import SeenCloud
from navcore.mapping.trellis.trellis_reference import TrellisReference, places_of, trellis_reference
from tests.navcore.mapping.standing_block import POST_HEIGHT, POST_RADIUS, StandingBlock

BLOCK = StandingBlock(lines=3, posts=4, margin=6.0)


def reference(*clouds: SeenCloud) -> TrellisReference:
    return trellis_reference(clouds, cells=False)


def nearest(places: np.ndarray, found: TrellisReference) -> np.ndarray:
    """Distance from each place to the nearest post found, m."""
    return np.asarray(KDTree(places_of(found.posts)).query(places)[0])


def test_every_post_is_found_where_it_stands() -> None:
    found = reference(BLOCK.seen())
    assert len(found.posts) == 12
    assert nearest(BLOCK.post_places(), found).max() < 0.02  # m
    assert all(abs(post.radius - POST_RADIUS) < 0.015 for post in found.posts)  # m
    assert all(abs(post.height - POST_HEIGHT) <= 0.21 for post in found.posts)  # m, a layer


def test_trunks_are_no_posts() -> None:
    found = reference(BLOCK.seen())
    assert len(found.trunks) == len(BLOCK.trunk_places())
    assert np.max(KDTree(places_of(found.trunks)).query(BLOCK.trunk_places())[0]) < 0.05  # m


def test_lines_lie_side_by_side_in_one_family() -> None:
    found = reference(BLOCK.seen())
    assert [len(line) for line in found.lines] == [4, 4, 4]
    assert found.families == ((0, 1, 2),)


def test_a_block_that_lies_askew_is_found_as_well() -> None:
    askew = StandingBlock(lines=3, posts=4, heading=0.7, margin=6.0)
    found = reference(askew.seen())
    assert len(found.posts) == 12
    assert nearest(askew.post_places(), found).max() < 0.02  # m


def test_leaves_hide_no_post_and_make_none() -> None:
    found = reference(BLOCK.seen(leaves=20_000))
    assert len(found.posts) == 12
    assert nearest(BLOCK.post_places(), found).max() < 0.02  # m


def test_a_post_seen_in_several_runs_says_in_how_many() -> None:
    found = reference(BLOCK.seen(seed=1), BLOCK.seen(seed=2, leaves=20_000), BLOCK.seen(seed=3))
    assert {post.times_seen for post in found.posts} == {3}


def test_a_post_that_the_newest_run_looks_through_is_gone() -> None:
    found = reference(BLOCK.seen(seed=1), BLOCK.seen(seed=2), BLOCK.seen(missing=(1,), seed=3))
    gone = BLOCK.post_places()[1]
    assert nearest(gone[None], found)[0] > 1.0  # m
    assert len(found.posts) == 11


def test_a_map_without_rays_finds_the_same_posts() -> None:
    found = reference(BLOCK.seen(rays=False))
    assert len(found.posts) == 12
    assert nearest(BLOCK.post_places(), found).max() < 0.04  # m


def test_stated_sigmas_are_no_smaller_than_a_third_of_the_errors() -> None:
    found = reference(BLOCK.seen())
    errors = KDTree(BLOCK.post_places()).query(places_of(found.posts))[0]
    assert (errors <= 3.0 * np.array([post.std for post in found.posts]) * np.sqrt(2.0)).mean() >= 0.9


def test_ground_follows_the_slope() -> None:
    ground = GroundModel.of([BLOCK.seen().points])
    assert np.abs(ground.height(BLOCK.post_places()) - BLOCK.slope * BLOCK.post_places()[:, 0]).max() < 0.05  # m


def test_no_points_and_points_that_are_no_farm_become_a_sentence() -> None:
    with pytest.raises(CloudError, match="no points"):
        reference()
    with pytest.raises(CloudError, match="kilometres apart"):
        reference(SeenCloud(points=np.array(((0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (9e5, 9e5, 0.0)))))
    with pytest.raises(CloudError, match="finite"):
        SeenCloud(points=np.array(((0.0, np.nan, 0.0),)))


def test_open_ground_has_no_posts() -> None:
    rng = np.random.default_rng(1)
    flat = np.column_stack((rng.uniform(0.0, 20.0, (5000, 2)), rng.normal(0.0, 0.01, 5000)))
    found = reference(SeenCloud(points=flat))
    assert found.posts == ()
    assert found.lines == ()
