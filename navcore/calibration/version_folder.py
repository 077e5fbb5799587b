"""The calibrations of one robot in a folder: every version of each camera, and a pointer to the one in use.

Beside the files `<camera>/<id>.json` stands `<camera>/in_use`, which holds an id and is all that is overwritten.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from navcore.calibration.calibration_file import (
    NAME,
    CalibrationVersion,
    load_version,
    new_id,
    save_version,
    versions,
)
from navcore.disk import write_durably
from navcore.errors import CalibrationError
from navcore.messages import CameraName

POINTER = "in_use"


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredVersion:
    """One file. `problem`: why it cannot be used, a sentence; then there is no `version`."""

    id: str
    version: CalibrationVersion | None
    problem: str = ""


class VersionFolder:
    """Of one robot; what is of another one is refused."""

    def __init__(self, folder: Path, robot: str) -> None:
        self._folder, self._robot = folder, robot

    def stored(self, camera: CameraName) -> tuple[StoredVersion, ...]:
        """All versions of a camera, the newest first, damaged ones too."""
        return tuple(self._stored(path) for path in versions(self._folder / camera))

    def add(self, camera: CameraName, version: CalibrationVersion) -> CalibrationVersion:
        """Keep a new version under an id that no other has. Raises CalibrationError if it cannot be written."""
        folder = self._folder / camera
        named = replace(version, id=new_id(version.made_utc, folder))
        save_version(named, folder / f"{named.id}.json")
        return named

    def use(self, camera: CameraName, version_id: str | None) -> None:
        """Point to a version, or to none. Raises CalibrationError for one that is not there or cannot be used."""
        pointer = self._folder / camera / POINTER
        try:
            if version_id is None:
                pointer.unlink(missing_ok=True)
                return
            self._load(camera, version_id)
            write_durably(pointer, f"{version_id}\n".encode())
        except OSError as error:
            raise CalibrationError((f"{pointer} cannot be written: {error.strerror}.",)) from error

    def in_use(self, camera: CameraName) -> str | None:
        """The id that the pointer holds; None if there is none."""
        try:
            return (self._folder / camera / POINTER).read_text(encoding="utf-8").strip()
        except FileNotFoundError:
            return None
        except (OSError, UnicodeDecodeError) as error:
            raise CalibrationError(
                (f"Which calibration is in use cannot be read: {error}. Choose one again.",)
            ) from error

    def load_in_use(self, camera: CameraName) -> CalibrationVersion | None:
        """The version in use; None if the settings hold. Raises CalibrationError for a damaged or foreign one."""
        version_id = self.in_use(camera)
        return None if version_id is None else self._load(camera, version_id)

    def _load(self, camera: CameraName, version_id: str) -> CalibrationVersion:
        path = self._folder / camera / f"{version_id}.json"
        if not NAME.fullmatch(version_id) or not path.is_file():
            raise CalibrationError(
                (f"There is no calibration {version_id[:64]!r} of that camera. Choose another one.",)
            )
        return load_version(path, robot=self._robot)

    def _stored(self, path: Path) -> StoredVersion:
        try:
            return StoredVersion(id=path.stem, version=load_version(path, robot=self._robot))
        except CalibrationError as error:
            return StoredVersion(id=path.stem, version=None, problem=str(error))
