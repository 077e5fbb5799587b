"""Drives one case in lockstep and keeps what the scorer needs."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from navcore.bench.evaluate.log import RecordBuilder
from navcore.bench.evaluate.record import RunRecord
from navcore.bench.mission.cases import CaseKind, EyeKind, Farms, MissionCase
from navcore.bench.mission.tracks import track_plan, track_site, track_start
from navcore.config import RobotConfig
from navcore.maps.mission import Mission
from navcore.maps.site_map import SiteMap
from navcore.messages import (
    CameraRequest,
    CameraView,
    LidarScan,
    MissionPlan,
    NavMode,
    Request,
    RequestKind,
    RunState,
    SegmentKind,
    SimTruth,
)
from navcore.perception.onnx_detector import OnnxDetector
from navcore.perception.row_perception import RowPerception
from navcore.planning.mission_planner import plan_mission
from navcore.planning.row_mission import mission_for_row
from navcore.runtime.lockstep import Eye, Lockstep, Tick
from navcore.runtime.row_eye import RowEye
from navcore.runtime.simulated_eye import ProjectedEye
from navcore.runtime.simulation import robot_cameras
from navcore.sim.camera_light import named_light
from navcore.sim.camera_renderer import CameraRenderer, Scene
from navcore.sim.layouts import scoring_layout, tuning_layout
from navcore.sim.map_error import NO_MAP_ERROR
from navcore.sim.orchard import Orchard, OrchardParams
from navcore.sim.world import World, WorldParams

_START_NS = 1_000_000_000
_RESTING = (RunState.FINISHED, RunState.STOPPED)


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveLimits:
    """When a drive is given up, in simulated seconds.

    Attributes:
        pose_s: until the first position. settle_s: standing after that.
        drive_s: for the whole mission.
    """

    pose_s: float = 30.0
    settle_s: float = 2.0
    drive_s: float = 1500.0


@dataclass(frozen=True, slots=True, kw_only=True)
class DriveOutcome:
    """A driven case.

    Attributes:
        state: of the mission at the end. why: what the operator was told last; empty after a finished mission.
        record: None if the mission was refused.
    """

    state: str
    why: str
    record: RunRecord | None


class PixelEye:
    """Rendered pictures through the shipped detector and the shipped row perception."""

    def __init__(self, orchard: Orchard, case: MissionCase, config: RobotConfig) -> None:
        light, detector, cameras = named_light(case.light, seed=case.seed), OnnxDetector(), robot_cameras()
        scene = Scene(orchard, light)
        self._renderers = {n: CameraRenderer(orchard, c, light, scene=scene) for n, c in cameras.items()}
        perceptions = {n: RowPerception(c, detector, config.perception) for n, c in cameras.items()}
        self._eye = RowEye(perceptions, cameras)
        self._frames = 0

    def look(self, truth: SimTruth, request: CameraRequest, scans: tuple[LidarScan, ...] = ()) -> CameraView:
        """See `lockstep.Eye`."""
        image = self._renderers[request.camera].render(truth, self._frames).image
        self._frames += 1
        return self._eye.look(image, truth.stamp_ns, request, scans=scans)


def drive_case(case: MissionCase, config: RobotConfig, limits: DriveLimits = DriveLimits()) -> DriveOutcome:
    """Build the case's world, drive it to its end, and say how it went."""
    site, plan, params = _set_up(case, config)
    world = World(site, config.vehicle_params(), params, start_ns=_START_NS)
    lockstep = Lockstep(world, config.new_navigator(site.datum), _eye(case, world, config))
    if case.kind is CaseKind.ROW_CHANGE:
        lockstep.listeners.append(lambda tick: _starve_between_rows(world, plan, tick))
    return _drive(lockstep, plan, limits)


def _set_up(case: MissionCase, config: RobotConfig) -> tuple[SiteMap, MissionPlan, WorldParams]:
    orchard = OrchardParams(season=case.season)
    if case.track is not None:
        unmoved = WorldParams(seed=case.seed, start=track_start(), orchard=orchard, map_error=NO_MAP_ERROR)
        return track_site(case.track), track_plan(case.track), unmoved
    site = (scoring_layout if case.farms is Farms.SCORING else tuning_layout)(case.farm)
    plan = plan_mission(site, _mission(case, site), config.vehicle_params())
    return site, plan, WorldParams(seed=case.seed, orchard=orchard)


def _mission(case: MissionCase, site: SiteMap) -> Mission:
    """One row of the farm, by the seed, at the case's speed."""
    row = site.rows[int(np.random.default_rng(case.seed).integers(len(site.rows)))]
    mission = mission_for_row(site, row.id, case.row_exit)
    return replace(mission, visits=tuple(replace(visit, speed=case.speed) for visit in mission.visits))


def on_gnss_alone(plan: MissionPlan) -> MissionPlan:
    """The same path as nothing but road: followed on GNSS everywhere, in rows too, so that no row has to be seen."""
    roads = tuple(
        replace(s, kind=SegmentKind.ROAD, row_id=None, row_start=None, row_end=None, corridor_width=None)
        for s in plan.segments
    )
    return replace(plan, segments=roads)


def _eye(case: MissionCase, world: World, config: RobotConfig) -> Eye | None:
    if case.kind in (CaseKind.GNSS_ONLY, CaseKind.TRACK):
        return None
    if case.eye is EyeKind.TRUTH:
        return ProjectedEye(world.orchard, case.seed, config.perception)
    return PixelEye(world.orchard, case, config)


def _starve_between_rows(world: World, plan: MissionPlan, tick: Tick) -> None:
    """Corrections are lost once the first row is driven, and return once the camera holds the second."""
    rows = [s.row_id for s in plan.segments if s.row_id is not None]
    status = tick.decision.status
    if status.mode is NavMode.ROW:
        world.faults = replace(world.faults, corrections_lost=status.row_id == rows[0])


def _drive(lockstep: Lockstep, plan: MissionPlan, limits: DriveLimits) -> DriveOutcome:
    lockstep.run(limits.pose_s, lambda tick: tick.decision.status.pose is not None)
    lockstep.run(limits.settle_s)
    builder = RecordBuilder(plan=plan)
    lockstep.listeners.append(lambda tick: _keep(builder, tick))
    driven = plan if lockstep.eye is not None else on_gnss_alone(plan)
    lockstep.ask(Request(kind=RequestKind.START, request_id="start", run_id="bench", plan=driven))
    reply = lockstep.tick().decision.replies[0]
    if not reply.accepted:
        return DriveOutcome(state="refused", why=" ".join(reply.reasons), record=None)
    last = lockstep.run(limits.drive_s, lambda tick: tick.decision.status.state in _RESTING)
    builder.add(lockstep.world.farm())
    for contact in lockstep.world.touched:
        builder.add(contact)
    status = last.decision.status
    finished = status.state is RunState.FINISHED
    why = "" if finished else "; ".join(e.text for e in status.events) or status.mode_reason
    return DriveOutcome(state=str(status.state), why=why, record=builder.record())


def _keep(builder: RecordBuilder, tick: Tick) -> None:
    builder.add(tick.truth)
    builder.add(tick.decision)
    for message in (*tick.views, *tick.inputs.rows, *tick.inputs.gnss):
        builder.add(message)
