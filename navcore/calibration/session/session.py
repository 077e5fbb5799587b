"""Takes poses of a board from live pictures, by itself or when asked to, and knows what is missing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import cv2

from navcore.calibration.board import BoardSighting, Image
from navcore.calibration.board_finder import BoardFinder, BoardFinderParams
from navcore.calibration.session.job import BoardLook, Job
from navcore.calibration.session.session_folder import SessionFolder
from navcore.calibration.session.state import SessionSetup, Taken
from navcore.calibration.session.still_board import StillBoard, StillBoardParams
from navcore.errors import CalibrationError
from navcore.messages import BoardPhase, CalibrationView, RawPicture

SHOWN_TAKEN_NS = 900_000_000
JPEG_QUALITY = 85
MOST_POSES = 120


class Session:
    """For one thread. What is taken is on disk when it is counted."""

    def __init__(self, setup: SessionSetup, folder: SessionFolder, job: Job, params: StillBoardParams) -> None:
        self.setup, self._folder, self._job = setup, folder, job
        self._finder = BoardFinder(setup.board, BoardFinderParams(tries_hard=False))
        self._still = StillBoard(params)
        self._poses, self.lost = folder.taken(setup.board)
        self.resumed = len(self._poses)
        self.revision = 0
        self._asked = False
        self._taken_ns = -SHOWN_TAKEN_NS
        self._wish = self._next_wish()

    @property
    def poses(self) -> Sequence[Taken]:
        """All that were taken, in order."""
        return tuple(self._poses)

    def ask_to_take(self) -> None:
        """Take the next picture that shows the board, whether it is still or not."""
        self._asked = True

    def keep(self, name: str, *, kept: bool) -> None:
        """Leave a pose out of the result, or bring it back. Raises CalibrationError for one that is not there."""
        for k, pose in enumerate(self._poses):
            if pose.name == name:
                changed = replace(pose, kept=kept)
                self._folder.save(changed)
                self._poses[k] = changed
                self._count()
                return
        raise CalibrationError((f"There is no picture {name[:20]!r} in this calibration. Load the page again.",))

    def see(self, picture: RawPicture, image: Image | None, why_none: str = "") -> CalibrationView:
        """One live picture (H, W), grey. `why_none`: what a slower look found out where no board is seen."""
        view = CalibrationView(
            stamp_ns=picture.stamp_ns, job=self.setup.job, camera=picture.camera, phase=BoardPhase.NO_PICTURE,
            words=picture.problem, width_px=picture.width_px, height_px=picture.height_px,
            rehearsal=self.setup.rehearsal,
        )  # fmt: skip
        if image is None:
            self._still.see(None, picture.stamp_ns)
        elif wrong := self._job.unfit(picture) or self._other_size(picture):
            self._still.see(None, picture.stamp_ns)
            view = replace(view, words=wrong)
        else:
            view = self._look(view, picture, image, why_none)
        return replace(view, taken=len(self._poses), revision=self.revision)

    def _look(self, view: CalibrationView, picture: RawPicture, image: Image, why_none: str) -> CalibrationView:
        found = self._finder.find(image, self._folder.next_name())
        stillness = self._still.see(None if isinstance(found, str) else found, picture.stamp_ns)
        if isinstance(found, str):
            self._asked = False
            return replace(view, phase=BoardPhase.NO_BOARD, words=why_none or found)
        look = self._job.look(found, picture, self._still.since_ns)
        if self._worth_taking(found, look, stillness):
            phase, words = self._take(found, image, picture.stamp_ns)
        else:
            phase, words = self._waiting(found, look, stillness, picture.stamp_ns)
        corners = tuple((u, v) for u, v in found.pixels.round(1).tolist())
        return replace(view, phase=phase, words=words, corners=corners, stillness=stillness, board=look.board)

    def _worth_taking(self, found: BoardSighting, look: BoardLook, stillness: float) -> bool:
        if look.problem:
            return False
        return self._asked or (stillness >= 1.0 and self._is_new(found))

    def _is_new(self, found: BoardSighting) -> bool:
        return self._still.is_new(found, (pose.sighting for pose in self._poses if pose.kept))

    def _waiting(
        self, found: BoardSighting, look: BoardLook, stillness: float, stamp_ns: int
    ) -> tuple[BoardPhase, str]:  # fmt: skip
        if look.problem:
            return BoardPhase.OFF_SCAN, look.problem
        if not self._is_new(found):
            if 0 <= stamp_ns - self._taken_ns < SHOWN_TAKEN_NS:
                return BoardPhase.TAKEN, f"Taken. {self._wish}"
            return BoardPhase.KNOWN, f"This pose is there already. {self._wish}"
        return (BoardPhase.STILL, "Hold it …") if stillness > 0.3 else (BoardPhase.MOVING, "Hold the board still.")

    def _take(self, found: BoardSighting, image: Image, stamp_ns: int) -> tuple[BoardPhase, str]:
        self._asked = False
        if len(self._poses) >= MOST_POSES:
            return BoardPhase.KNOWN, f"{MOST_POSES} pictures are there, more than enough. Accept the result."
        _, jpeg = cv2.imencode(".jpg", image, (cv2.IMWRITE_JPEG_QUALITY, JPEG_QUALITY))
        pose = Taken(sighting=found, scan=self._job.scan(self._still.since_ns))
        self._folder.save(pose, jpeg.tobytes())
        self._poses.append(pose)
        self._taken_ns = stamp_ns
        self._count()
        return BoardPhase.TAKEN, f"Taken. {self._wish}"

    def _count(self) -> None:
        self.revision += 1
        self._wish = self._next_wish()

    def _next_wish(self) -> str:
        missing = self._job.coverage(self._poses).missing
        return missing[0] if missing else "Nothing is missing: look at the result."

    def _other_size(self, picture: RawPicture) -> str:
        if not self._poses or self._poses[0].sighting.size == (picture.width_px, picture.height_px):
            return ""
        wide, high = self._poses[0].sighting.size
        return (
            f"The camera gives {picture.width_px}x{picture.height_px} pictures now, those taken before are "
            f"{wide}x{high}. Set the camera's size back, or throw this calibration away."
        )
