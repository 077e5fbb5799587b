"""Rendered training pictures with labels in COCO's format."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from navcore.errors import InputError
from navcore.messages import ObjectKind
from navcore.sim.camera_labels import LabelParams, RenderedObject
from navcore.sim.camera_renderer import CameraRenderer, RenderedFrame, RenderParams, Scene
from navcore.training.dataset_recipe import SceneRecipe, ShotRecipe, random_scene, random_shot

SHOTS_PER_SCENE = 12
CATEGORIES = {ObjectKind.TRUNK: 1, ObjectKind.POST: 2}
MOST_HIDDEN_SHARE = 0.25


def render_dataset(
    folder: Path, *, count: int, seed: int, report: Callable[[str], None] | None = None
) -> None:  # fmt: skip
    """Write `count` pictures to `folder`/images and their labels to `folder`/annotations.json.

    The same seed gives the same pictures. Sets of different seeds share no farm; use one seed each for training,
    validation and test. Beside COCO's fields an annotation has `ignore` (too far, small or hidden to count),
    `visible` (share), `range` (m), `foot_visible`, and `foot` (u, v px) where the foot is in the picture and nearly
    seen; an image has `season`, `light`, `trellis` and `place`.

    Raises InputError for a count or seed that makes no sense.
    """
    if count < 1 or seed < 0:
        raise InputError("Ask for at least one picture and give a seed that is not negative.")
    (folder / "images").mkdir(parents=True, exist_ok=True)
    document: dict[str, Any] = {
        "images": [], "annotations": [],
        "categories": [{"id": number, "name": str(kind)} for kind, number in CATEGORIES.items()],
    }  # fmt: skip
    for number, (scene, shot, frame) in enumerate(_shots(count, seed)):
        name = f"{number:06d}.jpg"
        quality = [cv2.IMWRITE_JPEG_QUALITY, shot.jpeg_quality]
        cv2.imwrite(str(folder / "images" / name), frame.image, quality)
        document["images"].append(_image(number, name, scene, shot, frame))
        first = len(document["annotations"])
        document["annotations"] += [_annotation(first + i, number, o, frame) for i, o in enumerate(frame.objects)]
        if report is not None and (number + 1) % 100 == 0:
            report(f"{number + 1} of {count} pictures")
    (folder / "annotations.json").write_text(json.dumps(document), encoding="utf-8")


def _shots(count: int, seed: int) -> Iterator[tuple[SceneRecipe, ShotRecipe, RenderedFrame]]:
    params = RenderParams(labels=LabelParams())
    for first in range(0, count, SHOTS_PER_SCENE):
        recipe = random_scene(seed, first // SHOTS_PER_SCENE)
        scene = Scene(recipe.orchard, recipe.light)
        rng = np.random.default_rng((seed, first, 31))
        for index in range(first, min(first + SHOTS_PER_SCENE, count)):
            shot = random_shot(recipe, rng)
            renderer = CameraRenderer(recipe.orchard, shot.camera, shot.light, params, scene=scene)
            yield recipe, shot, renderer.render(shot.truth, index)


def _image(number: int, name: str, scene: SceneRecipe, shot: ShotRecipe, frame: RenderedFrame) -> dict[str, Any]:
    return {
        "id": number, "file_name": f"images/{name}", "width": frame.image.shape[1], "height": frame.image.shape[0],
        "season": str(scene.orchard.season), "light": str(scene.light_name), "trellis": str(scene.orchard.trellis),
        "place": shot.place,
    }  # fmt: skip


def _annotation(number: int, image: int, seen: RenderedObject, frame: RenderedFrame) -> dict[str, Any]:
    width, height = seen.x2 - seen.x1, seen.y2 - seen.y1
    annotation = {
        "id": number, "image_id": image, "category_id": CATEGORIES[seen.kind], "area": width * height,
        "bbox": [seen.x1, seen.y1, width, height], "iscrowd": 0, "ignore": int(seen.ignore),
        "visible": round(seen.visible, 3), "range": round(seen.range, 2), "foot_visible": seen.foot_visible,
    }  # fmt: skip
    hidden = seen.foot_v - seen.y2
    if seen.foot_v <= frame.image.shape[0] and abs(hidden) <= MOST_HIDDEN_SHARE * height:
        annotation["foot"] = [round(seen.foot_u, 2), round(seen.foot_v, 2)]
    return annotation
