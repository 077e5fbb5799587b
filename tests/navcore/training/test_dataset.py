"""Rendered sets can be read back, repeat by seed, and share no farm with another seed."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from navcore.errors import InputError
from navcore.sim.layouts import scoring_layout
from navcore.training.dataset import SHOTS_PER_SCENE, render_dataset
from navcore.training.dataset_recipe import random_scene
from navcore.training.samples import read_samples


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("set")
    render_dataset(path, count=SHOTS_PER_SCENE + 2, seed=5)
    return path


def test_a_set_reads_back_with_boxes_inside_the_pictures(folder: Path) -> None:
    samples = read_samples(folder)
    assert len(samples) == SHOTS_PER_SCENE + 2
    assert sum(len(s.labels.boxes) for s in samples) > 20
    for sample in samples:
        assert sample.image().shape == (360, 640, 3)
        boxes = sample.labels.boxes
        assert (boxes[:, :2] >= 0).all()
        assert (boxes[:, 2] <= 640).all()
        assert (boxes[:, 3] <= 360).all()
        assert sample.season
        assert sample.light


def test_annotations_carry_the_fields_of_coco_and_ours(folder: Path) -> None:
    document = json.loads((folder / "annotations.json").read_text(encoding="utf-8"))
    assert {c["name"] for c in document["categories"]} == {"trunk", "post"}
    assert len({a["id"] for a in document["annotations"]}) == len(document["annotations"])
    assert {"bbox", "area", "iscrowd", "ignore", "visible", "range", "rows_nearer", "foot_visible"} <= set(
        document["annotations"][0]
    )


def test_the_same_seed_gives_the_same_set(folder: Path, tmp_path: Path) -> None:
    render_dataset(tmp_path, count=3, seed=5)
    for name in ("000000.jpg", "000002.jpg"):
        assert (tmp_path / "images" / name).read_bytes() == (folder / "images" / name).read_bytes()


def test_sets_of_different_seeds_share_no_farm_and_none_is_scored_on() -> None:
    rows = [random_scene(seed, n).site.rows for seed in (1, 2) for n in range(3)]
    rows += [scoring_layout(n).rows for n in range(10)]
    assert len(set(rows)) == len(rows)


def test_pictures_differ_in_light_within_a_scene(folder: Path) -> None:
    means = [float(sample.image().mean()) for sample in read_samples(folder)[:6]]
    assert max(means) > 1.1 * min(means)


@pytest.mark.parametrize(("count", "seed"), [(0, 1), (-3, 1), (5, -1)])
def test_a_senseless_order_is_refused(tmp_path: Path, count: int, seed: int) -> None:
    with pytest.raises(InputError, match="at least one picture"):
        render_dataset(tmp_path, count=count, seed=seed)
