"""Rendered training pictures with labels in COCO's format."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from navcore.errors import InputError
from navcore.messages import ObjectKind
from navcore.sim.camera_labels import LabelParams, RenderedObject
from navcore.sim.camera_renderer import CameraRenderer, RenderedFrame, RenderParams, Scene
from navcore.training.dataset_recipe import SceneRecipe, Setting, ShotRecipe, random_scene, random_shot

SHOTS_PER_SCENE = 12
CATEGORIES = {ObjectKind.TRUNK: 1, ObjectKind.POST: 2}
MOST_HIDDEN_SHARE = 0.25

_Part = tuple[list[dict[str, Any]], list[dict[str, Any]]]


def render_dataset(
    folder: Path, *, count: int, seed: int, processes: int = 1, setting: Setting = Setting(),
    report: Callable[[str], None] | None = None,
) -> None:  # fmt: skip
    """Write `count` pictures to `folder`/images and their labels to `folder`/annotations.json.

    The same seed gives the same pictures, whatever the number of processes. Sets of different seeds share no farm;
    use one seed each for training, validation and test. Beside COCO's fields an annotation has `ignore` (too far,
    small or hidden to count, or of too far a row), `visible` (share), `range` (m), `rows_nearer` (count),
    `foot_visible`, and `foot` (u, v px) where the foot is in the picture and nearly seen; an image has `season`,
    `light`, `trellis` and `place`.

    Raises InputError for a count or seed that makes no sense.
    """
    if count < 1 or seed < 0:
        raise InputError("Ask for at least one picture and give a seed that is not negative.")
    (folder / "images").mkdir(parents=True, exist_ok=True)
    orders = [
        _Order(folder, seed, n, min(n + SHOTS_PER_SCENE, count), setting) for n in range(0, count, SHOTS_PER_SCENE)
    ]
    document: dict[str, Any] = {
        "images": [], "annotations": [],
        "categories": [{"id": number, "name": str(kind)} for kind, number in CATEGORIES.items()],
    }  # fmt: skip
    for images, seen in _in_processes(orders, processes):
        first = len(document["annotations"])
        document["images"] += images
        document["annotations"] += [{"id": first + i, **a} for i, a in enumerate(seen)]
        if report is not None and len(document["images"]) % (20 * SHOTS_PER_SCENE) == 0:
            report(f"{len(document['images'])} of {count} pictures")
    (folder / "annotations.json").write_text(json.dumps(document), encoding="utf-8")


@dataclass(frozen=True, slots=True)
class _Order:
    """Pictures `first` to `end` - 1 of a set, all of one scene."""

    folder: Path
    seed: int
    first: int
    end: int
    setting: Setting


def _in_processes(orders: list[_Order], processes: int) -> Iterator[_Part]:
    if processes == 1:
        yield from map(_render_scene, orders)
        return
    with ProcessPoolExecutor(processes) as pool:
        yield from pool.map(_render_scene, orders)


def _render_scene(order: _Order) -> _Part:
    """Write the pictures of a scene; their images and annotations."""
    images, seen = [], []
    for number, scene, shot, frame in _shots(order):
        name = f"{number:06d}.jpg"
        quality = [cv2.IMWRITE_JPEG_QUALITY, shot.jpeg_quality]
        cv2.imwrite(str(order.folder / "images" / name), frame.image, quality)
        images.append(_image(number, name, scene, shot, frame))
        seen += [_annotation(number, o, frame) for o in frame.objects]
    return images, seen


def _shots(order: _Order) -> Iterator[tuple[int, SceneRecipe, ShotRecipe, RenderedFrame]]:
    recipe = random_scene(order.seed, order.first // SHOTS_PER_SCENE, order.setting)
    scene = Scene(recipe.orchard, recipe.light)
    rng = np.random.default_rng((order.seed, order.first, 31))
    for number in range(order.first, order.end):
        shot = random_shot(recipe, rng)
        params = RenderParams(labels=LabelParams())
        renderer = CameraRenderer(recipe.orchard, shot.camera, shot.light, params, scene=scene)
        yield number, recipe, shot, renderer.render(shot.truth, number)


def _image(number: int, name: str, scene: SceneRecipe, shot: ShotRecipe, frame: RenderedFrame) -> dict[str, Any]:
    return {
        "id": number, "file_name": f"images/{name}", "width": frame.image.shape[1], "height": frame.image.shape[0],
        "season": str(scene.orchard.season), "light": str(scene.light_name), "trellis": str(scene.orchard.trellis),
        "place": shot.place,
    }  # fmt: skip


def _annotation(image: int, seen: RenderedObject, frame: RenderedFrame) -> dict[str, Any]:
    width, height = seen.x2 - seen.x1, seen.y2 - seen.y1
    annotation = {
        "image_id": image, "category_id": CATEGORIES[seen.kind], "area": width * height,
        "bbox": [seen.x1, seen.y1, width, height], "iscrowd": 0, "ignore": int(seen.ignore),
        "visible": round(seen.visible, 3), "range": round(seen.range, 2), "rows_nearer": seen.rows_nearer,
        "foot_visible": seen.foot_visible,
    }  # fmt: skip
    hidden = seen.foot_v - seen.y2
    if seen.foot_v <= frame.image.shape[0] and abs(hidden) <= MOST_HIDDEN_SHARE * height:
        annotation["foot"] = [round(seen.foot_u, 2), round(seen.foot_v, 2)]
    return annotation
