"""What a map is good for."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from navcore.mapping.lidar3d.fix_placing import is_rtk
from navcore.mapping.lidar3d.georeference import Georeference
from navcore.mapping.lidar3d.keyframe import Keyframe
from navcore.mapping.lidar3d.loops import Loop
from navcore.mapping.pose_graph.pose_graph import Solution

# A fix or a loop that keeps less of its weight is not believed.
BELIEVED = 0.25
_MANY = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class MapReport:
    """Of one map.

    Attributes:
        drive: name of the run. turns: of the LiDAR; blurred: those whose motion is not known, left out.
        keyframes: number of them. driven: along them, m.
        lost: turns that the map about them did not hold; odometry bridged them. score: mean of the others' matches.
        loops_taken: that are believed. loops_refused: number of the others by reason.
        loop_rms: of the believed ones after the fit, m.
        georeferenced: whether the map lies in the site's `map` frame; else it begins at the drive's begin.
        rtk_share: of keyframes with an RTK fix, 0 to 1. fixes_doubted: RTK fixes that contradict the drive.
        fix_rms: of the believed RTK fixes after the fit, in the plane, m.
        cells: of the NDT map, all scales. map_bytes: memory of its cells. points: of the cloud. hectares: under them.
        doubts: sentences for people; none where all is well.
    """

    drive: str
    turns: int
    blurred: int
    keyframes: int
    driven: float
    lost: int
    score: float
    loops_taken: int
    loops_refused: dict[str, int]
    loop_rms: float | None
    georeferenced: bool
    rtk_share: float
    fixes_doubted: int
    fix_rms: float | None
    cells: int
    map_bytes: int
    points: int
    hectares: float
    doubts: tuple[str, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class FixFigures:
    """Of the RTK fixes of a solved drive; see `MapReport`."""

    share: float
    doubted: int
    rms: float | None
    worst: float


def fix_figures(keyframes: Sequence[Keyframe], solution: Solution | None) -> FixFigures:
    """`solution` of a graph with fixes; None where there was none."""
    placed = [k.fix for k in keyframes if k.fix is not None]
    rtk = np.array([is_rtk(fix.quality) for fix in placed], dtype=np.bool_)
    share = float(rtk.sum()) / max(len(keyframes), 1)
    if solution is None or not rtk.any() or not len(solution.position_weights):
        return FixFigures(share=share, doubted=0, rms=None, worst=0.0)
    off = np.hypot(*solution.position_errors[rtk, :2].T)
    believed = solution.position_weights[rtk] >= BELIEVED
    rms = float(np.sqrt(np.mean(off[believed] ** 2))) if believed.any() else None
    worst = float(off[~believed].max(initial=0.0))
    return FixFigures(share=share, doubted=int((~believed).sum()), rms=rms, worst=worst)


def lost_turns(keyframes: Sequence[Keyframe]) -> int:
    """Those that the map about them did not hold; before the second keyframe there is no such map."""
    return sum(k.lost for k in keyframes[2:])


def loop_rms(loops: Sequence[Loop], solution: Solution) -> float | None:
    """Of the believed ones, m."""
    kept = [m for m, w in zip(loops, solution.loop_weights, strict=True) if w >= BELIEVED]
    if not kept:
        return None
    p = solution.poses
    off = [(p[m.i].inverse() @ p[m.j]).t - m.T_i_j.t for m in kept]
    return float(np.sqrt(np.mean(np.sum(np.square(off), axis=1))))


def doubts(
    place: Georeference, fixes: FixFigures, keyframes: Sequence[Keyframe], blurred: int, turns: int, driven: float,
    taken: int,
) -> tuple[str, ...]:  # fmt: skip
    """What people should know before they drive on the map."""
    lost, scans = lost_turns(keyframes), sum(k.scans for k in keyframes)
    said = [place.reason] if place.reason else []
    if fixes.doubted > _MANY * max(fixes.share * len(keyframes), 1.0):
        said.append(
            f"{fixes.doubted} RTK fixes contradict the drive by up to {fixes.worst:.1f} m and were left out. "
            "Look at the antenna and the corrections before the next drive."
        )
    if lost > _MANY * scans:
        said.append(
            f"{lost} of {scans} turns did not fit what was seen before; odometry bridged them. Drive more slowly, "
            "or look whether the LiDAR sits firmly."
        )
    if blurred > _MANY * turns:
        said.append(f"{blurred} of {turns} turns were left out: odometry or IMU were silent. Look at their cables.")
    if not taken and driven > 100.0:
        said.append(
            "No place was passed twice, so nothing checks the map's bends. Drive down one row and back up the next."
        )
    return tuple(said)
