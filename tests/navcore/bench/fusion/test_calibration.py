"""The bench of calibration judges by what it measured."""

from __future__ import annotations

import pytest

from navcore.bench.fusion.calibration import (
    SEED,
    CameraScore,
    MountScore,
    camera_figures,
    mount_figures,
    mount_score,
)


def test_scoring_seeds_are_not_those_that_things_are_tuned_on() -> None:
    assert SEED >= 5000


def test_a_camera_far_above_the_floor_fails() -> None:
    good, bad = CameraScore(0.051, 0.050, 0.001), CameraScore(0.060, 0.050, 0.004)
    assert [f.ok for f in camera_figures([good], 1)] == [None, True, True]
    figures = camera_figures([good, bad], 1)
    assert [f.ok for f in figures] == [None, False, False]
    assert figures[1].value == pytest.approx(0.2)
    assert figures[0].baseline == pytest.approx(0.05)


def test_a_refused_mount_is_counted_and_not_averaged_away() -> None:
    scores = [MountScore((0.004, 0.1), (0.03, 2.0)), MountScore(None, (0.05, 3.0))]
    figures = {f.figure: f for f in mount_figures(scores, 1)}
    [refused] = [f for name, f in figures.items() if "refused" in name]
    assert (refused.value, refused.n) == (1.0, 2)
    [place] = [f for name, f in figures.items() if "place (RMS" in name]
    assert place.value == pytest.approx(4.0)  # mm
    assert (place.n, place.ok) == (1, True)
    assert mount_figures([MountScore(None, None)], 1)[0].ok is None


def test_planes_and_edges_beat_the_published_pairs() -> None:
    scores = [mount_score(seed, 25) for seed in (1, 2, 3, 4)]
    ours = [s.ours for s in scores if s.ours is not None]
    published = [s.published for s in scores if s.published is not None]
    assert len(ours) == len(published) == 4
    assert max(place for place, _ in ours) < 0.005  # m
    for part in range(2):
        assert sum(off[part] for off in ours) < sum(off[part] for off in published)
