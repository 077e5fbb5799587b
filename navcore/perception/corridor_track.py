"""One corridor as it is remembered from picture to picture, and what is expected of it before the first."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.angles import wrap
from navcore.geometry.se2 import SE2
from navcore.perception.corridor_fit import CorridorFitParams
from navcore.perception.passed_plants import PassedPlantsParams
from navcore.perception.row_lines import RowPrior

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class CorridorTrackerParams:
    """When a corridor is believed, and how fast belief fades. Ours; set on rendered frames.

    Attributes:
        fit: of one picture. passed: the plants that are out of sight.
        along_deg: a robot turned further from the row than that does not drive along it.
        width, width_std: usual corridor width where none is told, m; `told_width_std` where one is.
        offset_std, heading_std_deg: prior of a robot somewhere in a corridor, without a `RowPrior`.
        pitch_std_deg: 1-sigma of the camera's pitch about its mount: +-2 deg of terrain; `told_pitch_std_deg` about
            what the IMU tells of it.
        drift_per_m, turn_drift_per_m: how fast offset (m) and heading (rad) become uncertain per square root of a
            metre driven; `turn_slip` is the share of a turn by which odometry may be wrong.
        min_objects: fewer do not start a track.
        one_side_objects: so many on one side start a track where a `RowPrior` is given, the other side unseen.
        sure_std, sure_objects: so many start one where the prior is as certain as that, m: the last plants of a row,
            or those between two gaps.
        alone_side, alone_objects, alone_span: where no row is expected so many on each side, so many in all, and each
            side over so many metres make one: two trunks and a false box stand in line everywhere.
        alone_share: and that share of the near objects must stand on its lines.
        max_offset_std, max_heading_std_deg: a row less certain than that is not shown.
        carry, carry_pictures: so far a row counts as seen without any evidence, m, and for so many pictures: one that
            stands does not see by remembering.
        carry_on, carry_on_pictures: so far it is carried on beyond that, told as such, between plants that were seen:
            of a row's last 3 m nothing is in the picture. past: and so far past the last of them, m: wheels slip.
        lost_share, lost_frames: a track that explains less than that share of the near objects in so many pictures
            in a row is dropped.
        wrong_row: a corridor further from the prior than that share of the width is another row;
        wrong_sigmas, wrong_least: so is one by so many 1-sigma of the prior, but not nearer than that, m: in a turn a
            fit begins between two rows, and creeps over to the wrong one.
        wrong_heading_deg: one that runs that much off the prior is none: plants on a lattice stand in line crosswise
            too.
        wrong_width: a corridor wider or narrower than told by that share and by 3-sigma is none: a fit can creep over
            a line of plants until it holds two.
        max_prior_std: a prior less certain than that share of the width cannot tell a row from its neighbours.
        floor_offset, floor_heading_deg: 1-sigma of what no fit can see: mount, roll, planting.
    """

    fit: CorridorFitParams = CorridorFitParams()
    passed: PassedPlantsParams = PassedPlantsParams()
    along_deg: float = 12.0
    width: float = 3.0
    width_std: float = 0.45
    told_width_std: float = 0.15
    offset_std: float = 0.7
    heading_std_deg: float = 12.0
    pitch_std_deg: float = 1.3
    told_pitch_std_deg: float = 0.7
    drift_per_m: float = 0.04
    turn_drift_per_m: float = 0.02
    turn_slip: float = 0.2
    min_objects: int = 4
    one_side_objects: int = 3
    sure_std: float = 0.2
    sure_objects: int = 2
    alone_side: int = 2
    alone_objects: int = 8
    alone_span: float = 1.5
    alone_share: float = 0.6
    max_offset_std: float = 0.22
    max_heading_std_deg: float = 4.0
    carry: float = 1.0
    carry_pictures: int = 50
    carry_on: float = 4.0
    carry_on_pictures: int = 150
    past: float = 0.15
    lost_share: float = 0.34
    lost_frames: int = 4
    wrong_row: float = 0.5
    wrong_sigmas: float = 3.0
    wrong_least: float = 0.5
    wrong_heading_deg: float = 9.0
    wrong_width: float = 0.22
    max_prior_std: float = 0.3
    floor_offset: float = 0.02
    floor_heading_deg: float = 0.25


class Width(NamedTuple):
    """Of a corridor, m, and its 1-sigma."""

    mean: float
    std: float


@dataclass(slots=True)
class Track:
    """What is remembered of the last picture; `unseen` and `pictures` since the last evidence, m and a count.

    `reach` is how far ahead the last plants stand that were seen on its lines, m; `told` the pitch by the IMU, rad.
    """

    state: Floats
    covariance: Floats
    unseen: float = 0.0
    pictures: int = 0
    doubts: int = 0
    reach: float = -math.inf
    told: float = 0.0

    def see(self, x: Floats) -> None:
        """Plants (N,) stand on its lines so far ahead, m: the last but one counts, as the last may be a false one."""
        self.unseen, self.pictures = 0.0, 0
        if len(x) >= 2:
            self.reach = max(self.reach, float(np.partition(x, -2)[-2]))

    def carried(self, p: CorridorTrackerParams) -> float:
        """Metres by which it is carried on; 0 while it counts as seen."""
        return self.unseen if self.unseen > p.carry else 0.0

    def gone(self, p: CorridorTrackerParams) -> bool:
        """Unseen for too long, or past its last plants."""
        if self.carried(p) == 0.0:
            return self.pictures > p.carry_pictures
        return self.reach <= -p.past or self.unseen > p.carry_on or self.pictures > p.carry_on_pictures


def expected(prior: RowPrior | None, p: CorridorTrackerParams) -> tuple[Floats, Floats]:
    """Mean (4,) and covariance (4, 4) before the first picture."""
    offset, heading = (prior.offset, prior.heading) if prior else (0.0, 0.0)
    offset_std = prior.std if prior else p.offset_std
    heading_std = prior.heading_std if prior else math.radians(p.heading_std_deg)
    width = told_width(prior, p)
    pitch, pitch_std = told_pitch(prior, p)
    stds = np.array((offset_std, heading_std, width.std, pitch_std))
    return np.array((offset, heading, width.mean, pitch)), np.diag(stds**2)


def told_pitch(prior: RowPrior | None, p: CorridorTrackerParams) -> tuple[float, float]:
    """As the IMU has it, and its 1-sigma, rad; else that of the ground's bumps."""
    if prior is None or prior.pitch is None:
        return 0.0, math.radians(p.pitch_std_deg)
    return prior.pitch, math.radians(p.told_pitch_std_deg)


def told_width(prior: RowPrior | None, p: CorridorTrackerParams) -> Width:
    """The row's as drawn, the usual one where none is told."""
    told = prior.width if prior else None
    return Width(p.width, p.width_std) if told is None else Width(told, p.told_width_std)


def moved(track: Track, motion: SE2, prior: RowPrior | None, p: CorridorTrackerParams) -> Track:
    """The track seen from the new driving frame, less certain by what was driven and turned.

    The pitch is that of the ground under the robot: what it is beyond the told one is soon forgotten.
    """
    offset, heading, width, pitch = track.state
    across = offset + math.sin(heading) * motion.x - math.cos(heading) * motion.y
    distance = math.hypot(motion.x, motion.y)
    J = np.diag((1.0, 1.0, 1.0, 0.7))
    J[0, 1] = math.cos(heading) * motion.x + math.sin(heading) * motion.y
    covariance = J @ track.covariance @ J.T
    turn_var = p.turn_drift_per_m**2 * distance + (p.turn_slip * motion.yaw) ** 2
    told, told_std = told_pitch(prior, p)
    pitch_var = (1.0 - 0.7**2) * told_std**2
    covariance += np.diag((p.drift_per_m**2 * distance, turn_var, 0.02**2 * distance, pitch_var))
    state = np.array((across, wrap(heading - motion.yaw), width, told + 0.7 * (pitch - track.told)))
    return Track(
        state=state, covariance=covariance, unseen=track.unseen + distance, pictures=track.pictures + 1,
        doubts=track.doubts, reach=track.reach - motion.x, told=told,
    )  # fmt: skip


def furthest(prior: RowPrior | None, width: float, p: CorridorTrackerParams) -> float:
    """Distance from the prior at which a corridor is another row, m."""
    by_width = p.wrong_row * width
    return by_width if prior is None else min(by_width, max(p.wrong_sigmas * prior.std, p.wrong_least))


def other_row(track: Track, prior: RowPrior | None, p: CorridorTrackerParams) -> bool:
    """Whether the corridor lies or runs too far from the expected one to be it. A vague prior cannot say so."""
    if prior is None or prior.std > p.max_prior_std * track.state[2]:
        return False
    aside = abs(track.state[0] - prior.offset) > furthest(prior, float(track.state[2]), p)
    askew = abs(wrap(track.state[1] - prior.heading)) > math.radians(p.wrong_heading_deg)
    return bool(aside or askew)
