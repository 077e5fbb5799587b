"""Labelled pictures on disk: COCO's `annotations.json` beside the pictures."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.messages import ObjectKind
from navcore.training.ask_rule import AskRule

Floats = NDArray[np.float64]
Image = NDArray[np.uint8]
KINDS = (ObjectKind.TRUNK, ObjectKind.POST)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Labels:
    """What is in a picture.

    Attributes:
        boxes: (N, 4) x1, y1, x2, y2, pixels; y2 is where the object meets the ground, as far as that is told.
        kinds: (N,) index into `KINDS`.
        ignore: (N,) too far, small or hidden to count, neither as found nor as missed.
    """

    boxes: Floats
    kinds: NDArray[np.int64]
    ignore: NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Sample:
    """One labelled picture; `season` and `light` are empty where the set does not tell them."""

    path: Path
    labels: Labels
    season: str = ""
    light: str = ""

    def image(self) -> Image:
        """The picture (H, W, 3), BGR. Raises InputError if it cannot be read."""
        image = cv2.imread(str(self.path), cv2.IMREAD_COLOR)
        if image is None:
            raise InputError(f"The picture {self.path} cannot be read; render the set again.")
        return np.asarray(image, dtype=np.uint8)


def read_samples(folder: Path, rule: AskRule | None = None) -> tuple[Sample, ...]:
    """All pictures of a set, in the order of their ids; what is asked for goes by the rule, else by the set itself.

    Raises InputError for a set that cannot be used.
    """
    try:
        document = json.loads((folder / "annotations.json").read_text(encoding="utf-8"))
        kinds = {c["id"]: KINDS.index(ObjectKind(c["name"])) for c in document["categories"]}
        per_image: dict[int, list[dict[str, Any]]] = {image["id"]: [] for image in document["images"]}
        for annotation in document["annotations"]:
            per_image[annotation["image_id"]].append(annotation)
        images = sorted(document["images"], key=lambda image: image["id"])
        return tuple(_sample(folder, image, per_image[image["id"]], kinds, rule) for image in images)
    except OSError as error:
        raise InputError(f"There is no annotations.json in {folder}; name the folder of a rendered set.") from error
    except (KeyError, TypeError, ValueError, IndexError) as error:
        raise InputError(
            f"{folder / 'annotations.json'} is not a COCO set of trunks and posts: {error!r}."
        ) from error


def _sample(
    folder: Path,
    image: dict[str, Any],
    annotations: list[dict[str, Any]],
    kinds: dict[int, int],
    rule: AskRule | None,
) -> Sample:
    boxes = np.array([_box(a) for a in annotations], dtype=np.float64).reshape(-1, 4)
    if not np.isfinite(boxes).all():
        raise ValueError(f"picture {image['id']} has a box that is not finite")
    labels = Labels(
        boxes=boxes, kinds=np.array([kinds[a["category_id"]] for a in annotations], dtype=np.int64),
        ignore=np.array([_ignored(a, rule) for a in annotations], dtype=np.bool_),
    )  # fmt: skip
    return Sample(
        path=_picture(folder, str(image["file_name"])), labels=labels, season=str(image.get("season", "")),
        light=str(image.get("light", "")),
    )  # fmt: skip


def _ignored(annotation: dict[str, Any], rule: AskRule | None) -> bool:
    if rule is not None and rule.applies(annotation):
        return rule.ignores(annotation)
    return bool(annotation.get("ignore", annotation.get("iscrowd", 0)))


def _box(annotation: dict[str, Any]) -> tuple[float, float, float, float]:
    """x1, y1, x2, y2 with the lower edge at the foot, where grass hides it a little."""
    x, y, width, height = (float(v) for v in annotation["bbox"])
    bottom = y + height
    foot = annotation.get("foot")
    if foot is not None and math.isfinite(float(foot[1])):
        bottom = max(y + 1.0, float(foot[1]))
    return x, y, x + width, bottom


def _picture(folder: Path, name: str) -> Path:
    path = (folder / name).resolve()
    if not path.is_relative_to(folder.resolve()):
        raise ValueError(f"the picture {name} lies outside of the set")
    return path if path.exists() else folder / "images" / name
