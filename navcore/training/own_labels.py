"""Somebody's own labelled pictures: COCO, YOLO or labelme, told by what lies in the folder."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import yaml

from navcore.errors import InputError

PICTURES = (".jpg", ".jpeg", ".png", ".bmp", ".tif", ".tiff", ".webp")
# Labels are rounded: so far beyond the edge a box may reach, px.
EDGE_PX = 2.0


@dataclass(frozen=True, slots=True)
class OwnObject:
    """A box with its class as it was named; pixels, (x1, y1) top left."""

    name: str
    x1: float
    y1: float
    x2: float
    y2: float


@dataclass(frozen=True, slots=True)
class OwnPicture:
    """A picture with its objects."""

    path: Path
    width_px: int
    height_px: int
    objects: tuple[OwnObject, ...]


def read_own(folder: Path) -> tuple[OwnPicture, ...]:
    """All labelled pictures of a folder, by path. Raises InputError, in words, for what cannot be used."""
    documents = {path: _json(path) for path in sorted(folder.rglob("*.json"))}
    coco = {path: d for path, d in documents.items() if {"images", "annotations", "categories"} <= d.keys()}
    labelme = {path: d for path, d in documents.items() if "shapes" in d}
    if coco:
        found = [picture for path, document in coco.items() for picture in _told(path, _coco(path, document))]
    elif labelme:
        found = [picture for path, document in labelme.items() for picture in _told(path, _labelme(path, document))]
    else:
        found = list(_yolo(folder))
    if not found:
        raise InputError(f"{folder} holds no labelled pictures: neither COCO, nor YOLO, nor labelme.")
    return tuple(sorted(found, key=lambda picture: picture.path))


def _json(path: Path) -> dict[str, Any]:
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(f"{path} is no JSON: {error}.") from error
    return document if isinstance(document, dict) else {}


def _told(path: Path, pictures: Iterator[OwnPicture]) -> list[OwnPicture]:
    """A file of another shape than its format's is an error in words."""
    try:
        return list(pictures)
    except (KeyError, TypeError, ValueError, IndexError, AttributeError) as error:
        raise InputError(f"{path} is not what it seems to be: {error!r}.") from error


def _coco(path: Path, document: dict[str, Any]) -> Iterator[OwnPicture]:
    names = {c["id"]: str(c["name"]) for c in document["categories"]}
    objects: dict[Any, list[OwnObject]] = {image["id"]: [] for image in document["images"]}
    for a in document["annotations"]:
        x, y, width, height = (float(v) for v in a["bbox"])
        objects[a["image_id"]].append(OwnObject(names[a["category_id"]], x, y, x + width, y + height))
    for image in document["images"]:
        yield _checked(_beside(path.parent, str(image["file_name"])), objects[image["id"]])


def _labelme(path: Path, document: dict[str, Any]) -> Iterator[OwnPicture]:
    """Of whatever shape: its bounding box."""
    objects = []
    for shape in document["shapes"]:
        xs, ys = zip(*((float(x), float(y)) for x, y in shape["points"]), strict=True)
        objects.append(OwnObject(str(shape["label"]), min(xs), min(ys), max(xs), max(ys)))
    yield _checked(_beside(path.parent, str(document["imagePath"]).replace("\\", "/")), objects)


def _beside(folder: Path, name: str) -> Path:
    """A picture of the set: where it is said to be, in images/, or by its bare name."""
    for path in (folder / name, folder / "images" / name, folder / Path(name).name, folder.parent / "images" / name):
        if path.is_file():
            return path
    raise InputError(f"There is no picture {name} in {folder}.")


def _yolo(folder: Path) -> Iterator[OwnPicture]:
    """Label files beside the pictures, or in labels/ where those lie in images/."""
    names: list[str] | None = None
    for picture in sorted(path for path in folder.rglob("*") if path.suffix.lower() in PICTURES):
        labels = _yolo_labels(picture)
        if labels is None:
            continue
        names = names if names is not None else _yolo_names(folder)
        yield from _told(labels, _yolo_picture(picture, labels, names))


def _yolo_labels(picture: Path) -> Path | None:
    """The label file of a picture."""
    parts = list(picture.with_suffix(".txt").parts)
    if "images" in parts:
        parts[len(parts) - 1 - parts[::-1].index("images")] = "labels"
    for path in (Path(*parts), picture.with_suffix(".txt")):
        if path.is_file():
            return path
    return None


def _yolo_names(folder: Path) -> list[str]:
    """The classes' names, counted from 0. Raises InputError without."""
    for path in (folder / "classes.txt", folder / "obj.names", folder / "labels" / "classes.txt"):
        if path.is_file():
            return path.read_text(encoding="utf-8").split("\n")
    for path in sorted((*folder.glob("*.yaml"), *folder.glob("*.yml"))):
        return _yaml_names(path)
    raise InputError(
        f"YOLO's labels name classes by number: put data.yaml into {folder}, or classes.txt with a name a line."
    )


def _yaml_names(path: Path) -> list[str]:
    """`names` of a data.yaml: a list, or by number."""
    try:
        names = yaml.safe_load(path.read_text(encoding="utf-8"))["names"]
        return [str(names[k]) for k in range(len(names))]
    except (OSError, ValueError, KeyError, IndexError, TypeError, yaml.YAMLError) as error:
        raise InputError(f"{path} names no classes: {error}.") from error


def _yolo_picture(picture: Path, labels: Path, names: list[str]) -> Iterator[OwnPicture]:
    """Class, middle and size as shares of the picture."""
    width, height = _size(picture)
    objects = []
    for line in labels.read_text(encoding="utf-8").splitlines():
        if not line.strip():
            continue
        number, u, v, w, h = line.split()[:5]
        x, y, half_w, half_h = float(u) * width, float(v) * height, float(w) * width / 2, float(h) * height / 2
        objects.append(OwnObject(names[int(number)].strip(), x - half_w, y - half_h, x + half_w, y + half_h))
    yield _checked(picture, objects)


def _checked(path: Path, objects: list[OwnObject]) -> OwnPicture:
    """Boxes cut at the picture's edges. Raises InputError for one that lies outside, or is none."""
    width, height = _size(path)
    return OwnPicture(path, width, height, tuple(_inside(path, o, width, height) for o in objects))


def _inside(path: Path, o: OwnObject, width: int, height: int) -> OwnObject:
    told = f"{path.name}: the box of a {o.name!r}, {o.x1:.0f}, {o.y1:.0f} to {o.x2:.0f}, {o.y2:.0f} px,"
    if not all(map(math.isfinite, (o.x1, o.y1, o.x2, o.y2))) or o.x2 <= o.x1 or o.y2 <= o.y1:
        raise InputError(f"{told} is none.")
    if min(o.x1, o.y1) < -EDGE_PX or o.x2 > width + EDGE_PX or o.y2 > height + EDGE_PX:
        raise InputError(f"{told} lies outside of the picture, which has {width} x {height} px.")
    return OwnObject(o.name, max(o.x1, 0.0), max(o.y1, 0.0), min(o.x2, float(width)), min(o.y2, float(height)))


def _size(path: Path) -> tuple[int, int]:
    picture = cv2.imread(str(path), cv2.IMREAD_COLOR)
    if picture is None:
        raise InputError(f"The picture {path} cannot be read.")
    return picture.shape[1], picture.shape[0]
