"""Drives one of paper B's segments in lockstep and measures how far from its middle, every metre."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from navcore.bench.fusion.segment_cases import Chain, SegmentCase
from navcore.bench.fusion.segment_eyes import ChainEye, OracleEye, OurEye, Pictures, new_chain
from navcore.bench.fusion.segment_survey import SegmentSurvey
from navcore.bench.fusion.skeleton_eye import SkeletonEye
from navcore.bench.fusion.tree_matches import TreeMatches, WatchedEye
from navcore.config import RobotConfig
from navcore.errors import MissionError
from navcore.geometry.lidar_mount import robot_lidar
from navcore.maps.mission import RowExit
from navcore.messages import Request, RequestKind, RunState, SimTruth
from navcore.planning.mission_planner import plan_mission
from navcore.planning.row_mission import mission_for_row
from navcore.runtime.lockstep import Eye, Lockstep, Tick
from navcore.sim.lidar2d import Lidar2dParams
from navcore.sim.map_error import NO_MAP_ERROR
from navcore.sim.world import World, WorldParams
from navcore.sim.young_orchard import LENGTH_M, YoungSegment

Floats = NDArray[np.float64]

STATIONS = np.arange(1.0, LENGTH_M - 2.0)  # m along the row; near its end the robot stops to drive back
VEHICLE = "paper_b"
_START_NS = 1_000_000_000
_POSE_S, _SETTLE_S, _DRIVE_S = 30.0, 2.0, 240.0
_RESTING = (RunState.FINISHED, RunState.STOPPED)


NewEye = Callable[[SegmentCase, World, RobotConfig], Eye]


@dataclass(frozen=True, slots=True, kw_only=True)
class SegmentResult:
    """One driven segment.

    Attributes:
        off: lateral deviation from the middle as surveyed at each of `STATIONS`, m, + left; None where it never got
            to. planned: from the middle as it was meant to be planted.
        why: what the operator was told where it did not get through.
        ours, published: trees that the camera knows and the LiDAR placed, on the same pictures and scans; of
            `Chain.OURS` only.
        look_ms, published_ms: from scan and boxes to the row, median, ours and the published one; likewise.
    """

    case: SegmentCase
    off: tuple[float | None, ...]
    planned: tuple[float | None, ...]
    why: str
    ours: TreeMatches | None = None
    published: TreeMatches | None = None
    look_ms: float | None = None
    published_ms: float | None = None


def drive_segment(case: SegmentCase, new_eye: NewEye | None = None) -> SegmentResult:
    """From the headland through the segment to its far end, by the eye of the case's chain or by `new_eye`'s."""
    young, config = case.young(), replace(RobotConfig(), vehicle=VEHICLE)
    params = WorldParams(
        seed=young.seed, orchard=young.orchard, terrain=young.terrain, lidar2d=Lidar2dParams(), map_error=NO_MAP_ERROR
    )  # fmt: skip
    world = World(young.site, config.vehicle_params(), params, start_ns=_START_NS)
    eye = (new_eye or _eye)(case, world, config)
    lockstep = Lockstep(world, config.new_navigator(young.site.datum), eye)
    poses: list[tuple[float, float]] = []
    lockstep.listeners.append(lambda tick: poses.append((tick.truth.x, tick.truth.y)))
    survey = SegmentSurvey(young)
    why = _drive(lockstep, case, young, survey, config)
    there = survey.T_row_map.apply(np.array(poses))
    off, planned = (_at_stations(there, middle(there[:, 0])) for middle in (survey.middle, survey.planned))
    result = SegmentResult(case=case, off=off, planned=planned, why=why)
    if not isinstance(eye, WatchedEye):
        return result
    look_ms, published_ms = eye.milliseconds()
    return replace(result, ours=eye.ours, published=eye.published, look_ms=look_ms, published_ms=published_ms)


def _eye(case: SegmentCase, world: World, config: RobotConfig) -> Eye:
    mount, seed = robot_lidar(), case.young().seed
    if case.chain is Chain.ORACLE:
        return OracleEye(world.orchard, config, mount)
    pictures = None if case.chain is Chain.LIDAR else Pictures(world.orchard, case, seed)
    if case.chain is Chain.OURS and pictures is not None:
        published = ChainEye(new_chain(Chain.PUBLISHED, mount), None, mount)
        return WatchedEye(OurEye(pictures, config, mount), published, pictures, world.orchard, mount)
    if case.chain is Chain.SEGMENTATION and pictures is not None:
        return SkeletonEye(pictures)
    return ChainEye(new_chain(case.chain, mount), pictures, mount)


def _drive(
    lockstep: Lockstep, case: SegmentCase, young: YoungSegment, survey: SegmentSurvey, config: RobotConfig
) -> str:
    """Why it did not get through, empty if it did."""
    mission = mission_for_row(young.site, young.row, RowExit.REVERSE)
    mission = replace(mission, visits=tuple(replace(visit, speed=case.speed) for visit in mission.visits))
    try:
        plan = plan_mission(young.site, mission, config.vehicle_params())
    except MissionError as error:
        return str(error)
    lockstep.run(_POSE_S, lambda tick: tick.decision.status.pose is not None)
    lockstep.run(_SETTLE_S)
    lockstep.ask(Request(kind=RequestKind.START, request_id="start", run_id="bench", plan=plan))
    reply = lockstep.tick().decision.replies[0]
    if not reply.accepted:
        return " ".join(reply.reasons)
    last = lockstep.run(_DRIVE_S, lambda tick: _along(survey, tick.truth) >= STATIONS[-1] + 0.2 or _rests(tick))
    if _along(survey, last.truth) >= STATIONS[-1]:
        return ""
    return "; ".join(e.text for e in last.decision.status.events) or "not through in time"


def _along(survey: SegmentSurvey, truth: SimTruth) -> float:
    return survey.T_row_map.apply_point(truth.x, truth.y)[0]


def _rests(tick: Tick) -> bool:
    return tick.decision.status.state in _RESTING


def _at_stations(there: Floats, middle: Floats) -> tuple[float | None, ...]:
    """Left of the middle (N,) at each station when places (N, 2) first passed it, None where none did."""
    along, off = there[:, 0], there[:, 1] - middle
    found: list[float | None] = []
    for station in STATIONS:
        passed = np.flatnonzero((along[:-1] < station) & (along[1:] >= station) & (np.abs(off[1:]) < 1.5))
        if not len(passed):
            found.append(None)
            continue
        k = passed[0]
        share = (station - along[k]) / (along[k + 1] - along[k])
        found.append(float(off[k] + share * (off[k + 1] - off[k])))
    return tuple(found)
