"""The stored calibrations of the robot, and those of rehearsals."""

from __future__ import annotations

from backend.robot import RobotView
from backend.schemas import VersionChoice, VersionDocument
from backend.settings import Settings
from navcore.calibration.version_folder import VersionFolder
from navcore.errors import CalibrationError
from navcore.messages import CameraName


class CalibrationVersions:
    """Read from the folders each time: a command may have put one there."""

    def __init__(self, settings: Settings, robot: RobotView) -> None:
        self._robot = robot
        self._folders = {
            False: VersionFolder(settings.calibration_dir, settings.robot),
            True: VersionFolder(settings.rehearsal_dir, settings.robot),
        }

    def all(self) -> list[VersionDocument]:
        """Of each camera the newest first, those of rehearsals last."""
        return [
            VersionDocument(
                id=stored.id, camera=camera, version=stored.version, problem=stored.problem,
                in_use=stored.id == _in_use(folder, camera), rehearsal=rehearsal,
            )
            for rehearsal, folder in self._folders.items()
            for camera in CameraName
            for stored in folder.stored(camera)
        ]  # fmt: skip

    def use(self, choice: VersionChoice) -> None:
        """Put one in use. Raises ConflictError while a mission is under way, CalibrationError with the reason."""
        self._robot.require_standing("put a calibration in use")
        self._folders[choice.rehearsal].use(choice.camera, choice.id)
        if not choice.rehearsal:
            self._robot.load_calibration()


def _in_use(folder: VersionFolder, camera: CameraName) -> str | None:
    """None too where that cannot be read: choosing one mends it."""
    try:
        return folder.in_use(camera)
    except CalibrationError:
        return None
