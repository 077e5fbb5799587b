"""A trivial labelled set: dark trunks and bright posts on brown ground."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import cv2
import numpy as np


def draw_set(folder: Path, count: int, seed: int) -> None:
    """Write `count` pictures of 256 x 192 px and their annotations."""
    rng = np.random.default_rng(seed)
    (folder / "images").mkdir(parents=True)
    document: dict[str, Any] = {
        "images": [], "annotations": [], "categories": [{"id": 1, "name": "trunk"}, {"id": 2, "name": "post"}],
    }  # fmt: skip
    for number in range(count):
        image = np.clip(rng.normal((60, 90, 110), 8.0, (192, 256, 3)), 0, 255).astype(np.uint8)
        for u in (40, 100, 160, 220):
            kind, width, foot = int(rng.integers(2)), int(rng.integers(8, 16)), int(rng.integers(110, 180))
            colour = (20, 30, 40) if kind == 0 else (220, 220, 220)
            x, y = u + int(rng.integers(-15, 15)), foot - 6 * width
            cv2.rectangle(image, (x, y), (x + width - 1, foot - 1), colour, -1)
            document["annotations"].append(
                {"id": len(document["annotations"]), "image_id": number, "category_id": kind + 1,
                 "bbox": [x, y, width, foot - y], "ignore": 0}
            )  # fmt: skip
        name = f"images/{number:03d}.png"
        cv2.imwrite(str(folder / name), image)
        document["images"].append({"id": number, "file_name": name, "season": "growing", "light": "noon"})
    (folder / "annotations.json").write_text(json.dumps(document), encoding="utf-8")
