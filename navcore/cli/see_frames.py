"""Pictures and videos, frame by frame."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from navcore.errors import InputError
from navcore.perception.detector import Image


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Frame:
    """A picture (H, W, 3), BGR. `number` counts the frames of a video from 0; None for a single picture."""

    path: Path
    image: Image
    number: int | None = None
    rate: float = 0.0


def frames(path: Path) -> Iterator[Frame]:
    """All frames of a picture, of a video, or of the pictures in a folder. Raises InputError with a sentence."""
    if path.is_dir():
        pictures = sorted(p for p in path.iterdir() if cv2.haveImageReader(str(p)))
        if not pictures:
            raise InputError(f"There is no picture in {path}.")
        for picture in pictures:
            yield from frames(picture)
    elif not path.is_file():
        raise InputError(f"There is no {path}.")
    elif cv2.haveImageReader(str(path)):
        yield Frame(path=path, image=_picture(path))
    else:
        yield from _video(path)


def _picture(path: Path) -> Image:
    image = cv2.imread(str(path), cv2.IMREAD_COLOR)
    if image is None:
        raise InputError(f"The picture {path} is damaged.")
    return np.asarray(image, dtype=np.uint8)


def _video(path: Path) -> Iterator[Frame]:
    video = cv2.VideoCapture(str(path))
    try:
        rate, number = video.get(cv2.CAP_PROP_FPS), 0
        while (read := video.read())[0]:
            image = np.asarray(read[1], dtype=np.uint8)
            yield Frame(path=path, image=image, number=number, rate=rate if 0.5 < rate < 240.0 else 10.0)
            number += 1
        if number == 0:
            raise InputError(f"{path} is neither a picture nor a video that can be read.")
    finally:
        video.release()
