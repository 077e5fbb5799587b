"""Our row fit with one of its parts left out at a time: what each is worth."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from navcore.bench.rows.valid_frames import NewFitter
from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import PinholeCamera
from navcore.perception.corner_points import CornerPoints
from navcore.perception.corridor_fit import CorridorFitParams, foot_rays
from navcore.perception.corridor_track import CorridorTrackerParams
from navcore.perception.corridor_tracker import CorridorTracker
from navcore.perception.line_consensus import best_lines
from navcore.perception.passed_plants import PassedPlantsParams
from navcore.perception.row_lines import RowCue, RowLines, away_from_camera, missing_side

Floats = NDArray[np.float64]

# More plants than anybody passes.
NEVER = 10_000


class EachPictureAlone:
    """Without tracking: nothing of earlier pictures is used."""

    def __init__(self, camera: PinholeCamera) -> None:
        self._tracker = CorridorTracker(camera, CorridorTrackerParams())

    def fit(self, corners: CornerPoints, cue: RowCue) -> RowLines:
        """As if each picture were the first."""
        self._tracker.forget()
        return self._tracker.fit(corners, RowCue(prior=cue.prior, motion=None))

    def forget(self) -> None:
        """There is nothing to forget."""


class EachSideAlone:
    """Without the joint fit: the exact consensus of each side by itself, and no tracking, which needs the corridor.

    `on_ground`: plants scatter about their line by centimetres on the ground; else by pixels in the picture.
    """

    def __init__(self, camera: PinholeCamera, *, on_ground: bool) -> None:
        self._camera, p = camera, CorridorFitParams()
        scale = camera.width_px / 640 / camera.fx
        scatter = (p.plant_std, p.curve, p.scanned_std) if on_ground else (0.0, 0.0, 0.0)
        self._noise = (p.foot_u_px * scale, p.foot_v_px * scale, *scatter)

    def fit(self, corners: CornerPoints, cue: RowCue) -> RowLines:
        """The line of most support on each half of the picture."""
        left, right = self._line(corners.points[corners.left]), self._line(corners.points[~corners.left])
        return RowLines(
            left=left, right=right, kept=np.ones(len(corners), dtype=np.bool_), on_left=corners.left,
            left_seen=left is not None, right_seen=right is not None,
            reason="" if left and right else missing_side(left, right),
        )  # fmt: skip

    def forget(self) -> None:
        """There is nothing to forget."""

    def _line(self, feet: Floats) -> Line2 | None:
        c, rays = self._camera, foot_rays(self._camera, feet)
        near = rays[rays[:, 1] > c.z / CorridorFitParams().max_range]
        found = best_lines(near, 1, (c.x, c.y, c.z), self._noise)
        if len(found) == 0:
            return None
        return away_from_camera(Line2.through(*(self._pixel(found[0], down) for down in (0.4, 0.1))))

    def _pixel(self, line: Floats, down: float) -> tuple[float, float]:
        """Where the camera sees the ray of a line (m, b, support) that falls by `down` per metre ahead."""
        c, across = self._camera, float(line[0] + line[1] * down)
        ((u, v),) = c.project(np.array(((c.x + 1.0, c.y + across, c.z - down),)))
        return float(u), float(v)


def ablations(camera: PinholeCamera) -> dict[str, NewFitter]:
    """By what is left out; each call makes a new fitter. Nothing left out is `CorridorTracker` itself."""
    forgetful = CorridorTrackerParams(passed=PassedPlantsParams(least=NEVER))
    return {
        "without the plants passed": lambda: CorridorTracker(camera, forgetful),
        "without tracking": lambda: EachPictureAlone(camera),
        "without tracking and joint fit": lambda: EachSideAlone(camera, on_ground=True),
        "without tracking, joint fit and ground plane": lambda: EachSideAlone(camera, on_ground=False),
    }
