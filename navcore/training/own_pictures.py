"""Own labelled pictures put beside the rendered ones of a set."""

from __future__ import annotations

import json
import shutil
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from navcore.errors import InputError
from navcore.messages import ObjectKind
from navcore.training.dataset import CATEGORIES
from navcore.training.own_labels import OwnObject, OwnPicture

# What people call them. None: labelled, but neither trunk nor post.
KIND_OF: dict[str, ObjectKind | None] = {
    **dict.fromkeys(("trunk", "tree", "tree trunk", "vine", "grapevine", "vine trunk", "stem"), ObjectKind.TRUNK),
    **dict.fromkeys(("post", "pole", "pillar", "trellis post"), ObjectKind.POST),
    "none": None,
}


def told_kinds(told: Sequence[str]) -> dict[str, ObjectKind | None]:
    """What is said as NAME=trunk, NAME=post or NAME=none, over what people usually call them.

    Raises InputError for anything else.
    """
    kinds = dict(KIND_OF)
    for pair in told:
        name, equals, kind = pair.rpartition("=")
        if not equals or kind not in ("trunk", "post", "none"):
            raise InputError(f"Say NAME=trunk, NAME=post or NAME=none, not {pair!r}.")
        kinds[_plain(name)] = KIND_OF[kind]
    return kinds


def check_kinds(pictures: Sequence[OwnPicture], kinds: Mapping[str, ObjectKind | None]) -> None:
    """Raises InputError for classes that nobody has told."""
    names = {o.name for picture in pictures for o in picture.objects}
    strange = sorted(name for name in names if _plain(name) not in kinds)
    if strange:
        name = strange[0]
        raise InputError(
            f"It is not known what these classes are: {', '.join(strange)}. "
            f"Say --class {name!r}=trunk, =post, or =none to leave it out, and so for each."
        )


def add_own(folder: Path, pictures: Sequence[OwnPicture], kinds: Mapping[str, ObjectKind | None]) -> int:
    """Copy them to `folder`/images and label them in its annotations.json; how many are new.

    Those that were put there before are left out. Raises InputError before anything is written.
    """
    check_kinds(pictures, kinds)
    document = _document(folder)
    known = {image.get("source") for image in document["images"]}
    new = [picture for picture in pictures if _source(picture) not in known]
    first = max((image["id"] for image in document["images"]), default=-1) + 1
    for number, picture in enumerate(new, start=first):
        name = f"images/own-{number:06d}{picture.path.suffix.lower()}"
        shutil.copyfile(picture.path, folder / name)
        document["images"].append(
            {"id": number, "file_name": name, "width": picture.width_px, "height": picture.height_px,
             "source": _source(picture)}
        )  # fmt: skip
        document["annotations"] += _annotations(picture, number, len(document["annotations"]), kinds)
    part = folder / "annotations.part.json"
    part.write_text(json.dumps(document), encoding="utf-8")
    part.replace(folder / "annotations.json")
    return len(new)


def _document(folder: Path) -> dict[str, Any]:
    (folder / "images").mkdir(parents=True, exist_ok=True)
    path = folder / "annotations.json"
    if not path.exists():
        categories = [{"id": number, "name": str(kind)} for kind, number in CATEGORIES.items()]
        return {"images": [], "annotations": [], "categories": categories}
    try:
        document: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{path} cannot be read: {error}.") from error
    return document


def _source(picture: OwnPicture) -> str:
    """By which a picture is known again."""
    return str(picture.path.resolve())


def _annotations(
    picture: OwnPicture, image: int, first: int, kinds: Mapping[str, ObjectKind | None]
) -> list[dict[str, Any]]:
    meant = [(o, kind) for o in picture.objects if (kind := kinds[_plain(o.name)]) is not None]
    return [_annotation(o, kind, image, first + i) for i, (o, kind) in enumerate(meant)]


def _annotation(o: OwnObject, kind: ObjectKind, image: int, number: int) -> dict[str, Any]:
    width, height = o.x2 - o.x1, o.y2 - o.y1
    return {
        "id": number, "image_id": image, "category_id": CATEGORIES[kind], "bbox": [o.x1, o.y1, width, height],
        "area": width * height, "iscrowd": 0, "ignore": 0,
    }  # fmt: skip


def _plain(name: str) -> str:
    return name.strip().lower().replace("_", " ").replace("-", " ")
