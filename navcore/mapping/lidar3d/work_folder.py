"""Where keyframes wait for the graph: a folder that survives a kill, so that mapping goes on where it was."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import overload

from navcore.disk import write_durably
from navcore.errors import InputError
from navcore.mapping.lidar3d.keyframe import Keyframe, keyframe_bytes, read_keyframe

_VERSION = 1
_HEAD = "drive.json"


class WorkFolder(Sequence[Keyframe]):
    """Keyframes of one drive, each a file; read one by one, so memory does not grow with the drive."""

    def __init__(self, folder: Path, name: str, settings: str) -> None:
        """Open it for the drive `name`, mapped with `settings`, and keep what is whole of it.

        Raises InputError if the folder holds another drive, or cannot be written.
        """
        self._folder = folder
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._claim({"version": _VERSION, "drive": name, "settings": settings})
            self._count = self._whole()
        except OSError as error:
            raise InputError(f"The work folder {folder} cannot be used: {error.strerror}.") from error

    def __len__(self) -> int:
        return self._count

    @overload
    def __getitem__(self, index: int) -> Keyframe: ...
    @overload
    def __getitem__(self, index: slice) -> list[Keyframe]: ...
    def __getitem__(self, index: int | slice) -> Keyframe | list[Keyframe]:
        if isinstance(index, slice):
            return [self[i] for i in range(*index.indices(self._count))]
        if not -self._count <= index < self._count:
            raise IndexError(index)
        return read_keyframe(self._path(index % self._count).read_bytes())

    def __iter__(self) -> Iterator[Keyframe]:
        return (self[i] for i in range(self._count))

    def append(self, keyframe: Keyframe) -> None:
        """On disk, whole or not at all, when this returns. Raises InputError where the disk is full."""
        try:
            write_durably(self._path(self._count), keyframe_bytes(keyframe))
        except OSError as error:
            raise InputError(f"A keyframe cannot be kept: {error.strerror}. Make room on the disk, go on.") from error
        self._count += 1

    def delete(self) -> None:
        """Once the map is made."""
        for path in (*self._folder.glob("*.npz"), *self._folder.glob("*.unfinished"), self._folder / _HEAD):
            path.unlink(missing_ok=True)
        if not any(self._folder.iterdir()):
            self._folder.rmdir()

    def _claim(self, head: dict[str, object]) -> None:
        path = self._folder / _HEAD
        if path.exists():
            if _read_head(path) != head:
                raise InputError(
                    f"The work folder {self._folder} holds another drive, or this one mapped with other settings. "
                    "Delete it, or name another one."
                )
        elif any(self._folder.iterdir()):
            raise InputError(f"{self._folder} is not empty and no work folder of a map. Name another one.")
        else:
            path.write_text(json.dumps(head))

    def _whole(self) -> int:
        """How many keyframes there are without a gap; what comes after is thrown away."""
        count = 0
        while self._path(count).exists() and _readable(self._path(count)):
            count += 1
        for path in self._folder.glob("*.npz"):
            if int(path.stem) >= count:
                path.unlink()
        return count

    def _path(self, index: int) -> Path:
        return self._folder / f"{index:06d}.npz"


def _readable(path: Path) -> bool:
    try:
        read_keyframe(path.read_bytes())
    except InputError:
        return False
    return True


def _read_head(path: Path) -> object:
    try:
        return json.loads(path.read_bytes())
    except ValueError:
        return None
