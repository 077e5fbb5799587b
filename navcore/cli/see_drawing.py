"""What was seen, drawn over the picture."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import cv2

from navcore.cli.see_frames import Frame
from navcore.errors import InputError
from navcore.perception.detector import Image

BOX_INK = {"trunk": (80, 200, 80), "post": (40, 140, 255)}
LINE_INK = {"left": (255, 120, 40), "right": (60, 60, 255), "centre": (255, 255, 255)}


def drawn(image: Image, record: dict[str, Any]) -> Image:
    """A copy with boxes, lines and words."""
    canvas = image.copy()
    thick = max(1, round(image.shape[1] / 500))
    for seen in record["objects"]:
        x1, y1, x2, y2 = (round(v) for v in seen["box"])
        cv2.rectangle(canvas, (x1, y1), (x2, y2), BOX_INK[seen["class"]], thick)
    row = record["row"]
    for name, ink in LINE_INK.items() if row else ():
        near, far = ((round(u), round(v)) for u, v in row[name])
        cv2.line(canvas, near, far, ink, 2 * thick, cv2.LINE_AA)
    _words(canvas, f"row, quality {row['quality']:.2f}" if row else record["reason"] or "no row", thick)
    return canvas


def _words(canvas: Image, text: str, thick: int) -> None:
    """White on a dark bar along the lower edge."""
    bar = 18 * thick
    canvas[-bar:] = canvas[-bar:] // 4
    place = (4 * thick, canvas.shape[0] - 5 * thick)
    cv2.putText(canvas, text, place, cv2.FONT_HERSHEY_SIMPLEX, 0.45 * thick, (255, 255, 255), thick, cv2.LINE_AA)


class Drawings:
    """A folder of drawn pictures: one JPEG for each picture, one video for each video."""

    def __init__(self, folder: Path) -> None:
        """Raises InputError if the folder cannot be made."""
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(f"The drawings cannot be put into {folder}: {error.strerror}.") from error
        self._folder = folder
        self._names: dict[Path, Path] = {}
        self._video: tuple[Path, cv2.VideoWriter] | None = None

    def add(self, frame: Frame, record: dict[str, Any]) -> None:
        """Draw one frame. Raises InputError if it cannot be written."""
        picture = drawn(frame.image, record)
        target = self._target(frame)
        if frame.number is not None:
            self._writer(target, frame).write(picture)
        elif not cv2.imwrite(str(target), picture):
            raise InputError(f"{target} cannot be written.")

    def close(self) -> None:
        """Finish the last video."""
        if self._video is not None:
            self._video[1].release()
        self._video = None

    def _writer(self, target: Path, frame: Frame) -> cv2.VideoWriter:
        if self._video is None or self._video[0] != target:
            self.close()
            size = (frame.image.shape[1], frame.image.shape[0])
            video = cv2.VideoWriter(str(target), cv2.VideoWriter.fourcc(*"mp4v"), frame.rate, size)
            if not video.isOpened():
                raise InputError(f"{target} cannot be written.")
            self._video = (target, video)
        return self._video[1]

    def _target(self, frame: Frame) -> Path:
        """One name for each source; sources of the same name from two folders do not overwrite each other."""
        if frame.path not in self._names:
            suffix = ".jpg" if frame.number is None else ".mp4"
            taken, n = set(self._names.values()), 1
            while (target := self._folder / f"{frame.path.stem}{'' if n == 1 else f'-{n}'}{suffix}") in taken:
                n += 1
            self._names[frame.path] = target
        return self._names[frame.path]
