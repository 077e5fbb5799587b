"""Own labelled pictures: three formats tell the same, and what is wrong is said before anything is copied."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from navcore.cli import app
from navcore.errors import InputError
from navcore.training.own_labels import read_own
from navcore.training.own_pictures import add_own, told_kinds
from navcore.training.samples import read_samples
from tests.navcore.training.farm_pictures import draw_set

WIDTH, HEIGHT = 200, 100
BOX = (20.0, 30.0, 40.0, 90.0)
runner = CliRunner()


def picture(folder: Path, name: str = "a.png") -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    cv2.imwrite(str(folder / name), np.full((HEIGHT, WIDTH, 3), 90, dtype=np.uint8))
    return folder / name


def coco(folder: Path, box: tuple[float, ...] = BOX, name: str = "vine") -> Path:
    picture(folder)
    x1, y1, x2, y2 = box
    document = {
        "images": [{"id": 5, "file_name": "a.png"}], "categories": [{"id": 3, "name": name}],
        "annotations": [{"id": 1, "image_id": 5, "category_id": 3, "bbox": [x1, y1, x2 - x1, y2 - y1]}],
    }  # fmt: skip
    (folder / "_annotations.coco.json").write_text(json.dumps(document))
    return folder


def labelme(folder: Path, box: tuple[float, ...] = BOX, name: str = "vine") -> Path:
    picture(folder)
    x1, y1, x2, y2 = box
    shape = {"label": name, "shape_type": "polygon", "points": [[x1, y2], [x2, y1], [(x1 + x2) / 2, y1]]}
    (folder / "a.json").write_text(json.dumps({"imagePath": "a.png", "shapes": [shape]}))
    return folder


def yolo(folder: Path, box: tuple[float, ...] = BOX, name: str = "vine") -> Path:
    picture(folder / "images" / "train")
    x1, y1, x2, y2 = box
    (folder / "labels" / "train").mkdir(parents=True)
    shares = ((x1 + x2) / 2 / WIDTH, (y1 + y2) / 2 / HEIGHT, (x2 - x1) / WIDTH, (y2 - y1) / HEIGHT)
    (folder / "labels" / "train" / "a.txt").write_text(f"1 {' '.join(map(str, shares))}\n")
    (folder / "data.yaml").write_text(f"names: [car, {name}]\n")
    return folder


FORMATS = [coco, labelme, yolo]


@pytest.mark.parametrize("written", FORMATS)
def test_every_format_tells_the_same(written: Any, tmp_path: Path) -> None:
    (found,) = read_own(written(tmp_path / "mine"))
    (seen,) = found.objects
    assert (found.width_px, found.height_px, seen.name) == (WIDTH, HEIGHT, "vine")
    assert (seen.x1, seen.y1, seen.x2, seen.y2) == pytest.approx(BOX, abs=1e-6)  # px


@pytest.mark.parametrize("names", ["car\nvine\n", None])
def test_yolos_classes_have_names_or_it_is_said_where_to_write_them(names: str | None, tmp_path: Path) -> None:
    folder = yolo(tmp_path / "mine")
    (folder / "data.yaml").unlink()
    if names is None:
        with pytest.raises(InputError, match=r"classes\.txt"):
            read_own(folder)
        return
    (folder / "classes.txt").write_text(names)
    assert read_own(folder)[0].objects[0].name == "vine"


@pytest.mark.parametrize("written", FORMATS)
@pytest.mark.parametrize(
    "box",
    [(20.0, 30.0, 260.0, 90.0), (-30.0, 30.0, 40.0, 90.0), (20.0, 30.0, 20.0, 30.0), (20.0, 30.0, np.nan, 90.0)],
)
def test_a_box_outside_of_its_picture_or_without_a_size_is_refused(
    written: Any, box: tuple[float, ...], tmp_path: Path
) -> None:
    with pytest.raises(InputError, match=r"a\.png"):
        read_own(written(tmp_path / "mine", box))


@pytest.mark.parametrize(
    "content", ["{", "[]", '{"shapes": 3}', '{"images": [], "annotations": [{}], "categories": []}']
)
def test_labels_that_are_none_are_an_error_in_words(content: str, tmp_path: Path) -> None:
    picture(tmp_path)
    (tmp_path / "a.json").write_text(content)
    with pytest.raises(InputError):
        read_own(tmp_path)


def test_a_picture_that_is_missing_or_broken_is_named(tmp_path: Path) -> None:
    (coco(tmp_path) / "a.png").unlink()
    with pytest.raises(InputError, match=r"a\.png"):
        read_own(tmp_path)
    (tmp_path / "a.png").write_bytes(b"no picture")
    with pytest.raises(InputError, match=r"a\.png"):
        read_own(tmp_path)


def test_own_pictures_stand_beside_the_rendered_ones_once(tmp_path: Path) -> None:
    draw_set(tmp_path / "set", 3, 1)
    pictures = read_own(coco(tmp_path / "mine"))
    assert add_own(tmp_path / "set", pictures, told_kinds([])) == 1
    assert add_own(tmp_path / "set", pictures, told_kinds([])) == 0
    samples = read_samples(tmp_path / "set")
    assert len(samples) == 4
    assert samples[-1].labels.boxes == pytest.approx(np.array([BOX]))
    assert samples[-1].image().shape == (HEIGHT, WIDTH, 3)
    ids = [a["id"] for a in json.loads((tmp_path / "set" / "annotations.json").read_text())["annotations"]]
    assert len(set(ids)) == len(ids)


def test_the_verb_takes_own_pictures_alone_and_asks_what_a_strange_class_is(tmp_path: Path) -> None:
    mine, out = labelme(tmp_path / "mine", name="Rebstock"), tmp_path / "set"
    asked = runner.invoke(app, ["dataset", str(out), "--count", "0", "--own", str(mine)])
    assert asked.exit_code == 1
    assert "Rebstock" in asked.stderr
    assert not out.exists()
    told = ["dataset", str(out), "--count", "0", "--own", str(mine), "--class", "Rebstock=trunk"]
    assert runner.invoke(app, told).exit_code == 0
    assert len(read_samples(out)) == 1


def test_a_class_that_is_left_out_leaves_its_picture_as_background(tmp_path: Path) -> None:
    add_own(tmp_path / "set", read_own(coco(tmp_path / "mine", name="car")), told_kinds(["car=none"]))
    (sample,) = read_samples(tmp_path / "set")
    assert len(sample.labels.boxes) == 0


@pytest.mark.parametrize("told", ["vine", "vine=bush", "=", ""])
def test_a_class_told_in_another_way_is_refused(told: str) -> None:
    with pytest.raises(InputError, match="NAME="):
        told_kinds([told])
