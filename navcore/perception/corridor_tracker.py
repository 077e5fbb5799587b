"""The default row fitter: the corridor on the ground, followed from picture to picture."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import PinholeCamera
from navcore.perception.corner_points import CornerPoints
from navcore.perception.corridor_fit import Corridor, CorridorFit
from navcore.perception.corridor_track import (
    CorridorTrackerParams,
    Track,
    Width,
    expected,
    furthest,
    moved,
    other_row,
    told_pitch,
    told_width,
)
from navcore.perception.image_lines import image_line
from navcore.perception.passed_plants import PassedPlants
from navcore.perception.row_lines import GroundRow, RowCue, RowLines, RowPrior
from navcore.perception.scan_evidence import ScanEvidence, nothing_scanned

Floats = NDArray[np.float64]

# What stands nearer is seen nearly always, m.
NEAR_M = 8.0


class CorridorTracker:
    """Follows one corridor; starts anew where the motion between two pictures is not known."""

    def __init__(self, camera: PinholeCamera, params: CorridorTrackerParams) -> None:
        self._camera = camera
        self._params = params
        self._fit = CorridorFit(camera, params.fit)
        self._passed = PassedPlants(camera.x, params.passed)
        self._track: Track | None = None

    def forget(self) -> None:
        """Drop the track."""
        self._track = None

    def fit(self, corners: CornerPoints, cue: RowCue) -> RowLines:
        """Predict, then follow; or look for the corridor that fits picture and prior best."""
        self._track = self._predicted(cue)
        scan = cue.scan or nothing_scanned(len(corners))
        if self._track is not None:
            return self._follow(self._track, corners, scan, told_width(cue.prior, self._params))
        if len(corners) + len(scan.plants) == 0:
            return _nothing(corners, "no trunk or post in sight")
        return self._start(corners, scan, cue.prior)

    def _predicted(self, cue: RowCue) -> Track | None:
        """The track in the frame of this picture, None if there is none or it follows another row."""
        if self._track is None or cue.motion is None:
            return None
        track = moved(self._track, cue.motion, cue.prior, self._params)
        self._passed.move(cue.motion)
        return None if other_row(track, cue.prior, self._params) else track

    def _follow(self, track: Track, corners: CornerPoints, scan: ScanEvidence, told: Width) -> RowLines:
        # A scan shows the passed plants themselves, as long as it shows any.
        expected_now = (track.state, _inverse(track.covariance)) if len(scan.plants) else self._with_passed(track)
        corridor = self._fit.follow(corners.feet, *expected_now, scan)
        seen = int(np.count_nonzero(corridor.told_sides))
        near = int(np.count_nonzero(np.abs(corridor.told_x) < NEAR_M))
        track.doubts = track.doubts + 1 if near >= 4 and seen < self._params.lost_share * near else 0
        if seen:
            track.see(corridor.told_x[self._on_lines(corridor)])
            self._remember(corridor)
        else:  # plants passed before tell nothing new: odometry carries them as it carries the row
            corridor = replace(corridor, state=track.state, covariance=track.covariance)
        track.state, track.covariance = corridor.state, corridor.covariance
        reason = self._doubt(track, corridor, told)
        if reason:
            self._track = None
            return _nothing(corners, reason)
        return self._lines(corridor, corners, scan, track.carried(self._params))

    def _start(self, corners: CornerPoints, scan: ScanEvidence, prior: RowPrior | None) -> RowLines:
        mean, covariance = expected(prior, self._params)
        if math.sqrt(covariance[0, 0]) > self._params.max_prior_std * mean[2]:
            return _nothing(corners, "the row's expected place is too vague to tell it from its neighbours")
        turn = math.radians(self._params.wrong_heading_deg) if prior is not None else math.pi / 2
        reach = (furthest(prior, float(mean[2]), self._params), turn)
        corridor = self._fit.acquire(corners.feet, mean, _inverse(covariance), reach, scan)
        reason = self._too_little(corridor, prior)
        told, _ = told_pitch(prior, self._params)
        track = Track(state=corridor.state, covariance=corridor.covariance, told=told)
        reason = reason or self._doubt(track, corridor, told_width(prior, self._params))
        if reason:
            return _nothing(corners, reason)
        track.see(corridor.told_x[self._on_lines(corridor)])
        self._track = track
        self._passed.forget()
        return self._lines(corridor, corners, scan)

    def _remember(self, corridor: Corridor) -> None:
        """A robot that turns into the row has passed no plant of it."""
        if abs(corridor.state[1]) > math.radians(self._params.along_deg):
            self._passed.forget()
        else:
            self._passed.see(corridor.xy, corridor.sides)

    def _with_passed(self, track: Track) -> tuple[Floats, Floats]:
        """What is expected of the corridor with what the plants tell that are out of sight: mean and information."""
        known = _inverse(track.covariance)
        more, vector = self._passed.information(track.state)
        together = known + more
        mean: Floats = np.linalg.solve(together, known @ track.state + vector).astype(np.float64)
        return mean, together

    def _too_little(self, corridor: Corridor, prior: RowPrior | None) -> str:
        """Why a corridor has too little evidence to begin with, empty if it has enough."""
        left, right = corridor.on_sides()
        objects = len(corridor.told_x)
        if prior is None and not self._row_by_itself(corridor):
            return _too_few(objects, self._params.alone_objects)
        if min(left, right) >= 1 and left + right >= self._params.min_objects:
            return ""
        if prior is not None and prior.width is not None and max(left, right) >= self._params.one_side_objects:
            return ""
        if prior is not None and prior.std <= self._params.sure_std and left + right >= self._params.sure_objects:
            return ""
        return _too_few(objects, self._params.min_objects)

    def _row_by_itself(self, corridor: Corridor) -> bool:
        """Whether what stands there is a row although none is expected. The camera alone says so: a scan shows plants
        all around, and some of them stand in line everywhere.
        """
        p, x = self._params, np.nan_to_num(corridor.x, nan=np.inf)
        lines = [x[corridor.sides == side] for side in (1, -1)]
        enough = sum(map(len, lines)) >= p.alone_objects and min(map(len, lines)) >= p.alone_side
        near = x < NEAR_M
        on_lines = np.count_nonzero(corridor.sides[near]) >= p.alone_share * np.count_nonzero(near)
        return enough and bool(on_lines) and all(np.ptp(line) >= p.alone_span for line in lines)

    def _doubt(self, track: Track, corridor: Corridor, told: Width) -> str:
        """Why a corridor is not shown, empty if it is."""
        p = self._params
        offset_std, heading_std = np.sqrt(np.diag(track.covariance)[:2])
        if track.gone(p):
            return "no trunk or post " + ("on the row's lines" if len(corridor.told_x) else "in sight")
        if track.doubts >= p.lost_frames:
            return "most trunks and posts in sight do not stand on the row's lines"
        if abs(track.state[2] - told.mean) > max(p.wrong_width * told.mean, 3.0 * told.std):
            return f"a corridor of {track.state[2]:.1f} m is not the row of {told.mean:.1f} m"
        if offset_std > p.max_offset_std:
            return f"the row's place is only known to {offset_std:.2f} m"
        if heading_std > math.radians(p.max_heading_std_deg):
            return f"the row's direction is only known to {math.degrees(heading_std):.0f} deg"
        return ""

    def _lines(self, corridor: Corridor, corners: CornerPoints, scan: ScanEvidence, carried: float = 0.0) -> RowLines:
        offset, heading, width, pitch = (float(a) for a in corridor.state)
        left, right = (self._image(offset + side * width / 2, heading, pitch) for side in (1.0, -1.0))
        on_left = np.where(corridor.sides == 0, corners.left, corridor.sides > 0)
        return RowLines(
            left=left, right=right, kept=corridor.sides != 0, on_left=on_left,
            left_seen=corridor.on_sides()[0] > 0, right_seen=corridor.on_sides()[1] > 0,
            ground=self._ground(corridor, carried, len(scan.plants) > 0), plant_sides=corridor.plant_sides,
        )  # fmt: skip

    def _image(self, offset: float, heading: float, pitch: float) -> Line2:
        return image_line(self._camera, offset=offset, heading=heading, pitch=pitch)

    def _on_lines(self, corridor: Corridor) -> NDArray[np.bool_]:
        """Which plants stand on the lines, and near enough to tell where the row ends."""
        return np.asarray((corridor.told_sides != 0) & (corridor.told_x <= self._params.fit.max_range))

    def _ground(self, corridor: Corridor, carried: float, scanned: bool) -> GroundRow:
        p = self._params
        floor = np.diag((p.floor_offset**2, math.radians(p.floor_heading_deg) ** 2))
        covariance = corridor.covariance[:2, :2] + floor
        on_lines = self._on_lines(corridor)
        x, sides = corridor.told_x[on_lines], corridor.told_sides[on_lines]
        return GroundRow(
            offset=float(corridor.state[0]), heading=float(corridor.state[1]), width=float(corridor.state[2]),
            covariance=covariance, pitch=float(corridor.state[3]),
            left_x=x[sides > 0], right_x=x[sides < 0],
            quality=_quality(corridor, math.sqrt(covariance[0, 0]), p),
            beside=corridor.xy[(corridor.sides == 0) & np.isfinite(corridor.x)], carried=carried,
            scanned=scanned,
        )  # fmt: skip


def _too_few(objects: int, needed: int) -> str:
    if objects < needed:
        return f"only {objects} trunk{'s' if objects > 1 else ''} or posts in sight"
    return "the trunks and posts in sight do not form a row"


def _nothing(corners: CornerPoints, reason: str) -> RowLines:
    none = np.zeros(len(corners), dtype=np.bool_)
    return RowLines(
        left=None, right=None, kept=none, on_left=corners.left, left_seen=False, right_seen=False, reason=reason
    )


def _inverse(matrix: Floats) -> Floats:
    return np.asarray(np.linalg.inv(matrix), dtype=np.float64)


def _quality(corridor: Corridor, offset_std: float, p: CorridorTrackerParams) -> float:
    """0 to 1: how many objects carry the fit, on how many sides, and how certain it is."""
    left, right = corridor.on_sides()
    sides = 1.0 if left and right else 0.6 if left or right else 0.3
    enough = min(1.0, (left + right) / 6.0) if left or right else 1.0
    return sides * enough * min(1.0, max(0.0, 1.2 - offset_std / p.max_offset_std))
