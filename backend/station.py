"""The parts of a running station, wired once: the composition root."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import dataclass
from datetime import timedelta

from backend import uploads
from backend.audit import AuditBook
from backend.calibration_versions import CalibrationVersions
from backend.calibrator.client import Calibrator
from backend.calibrator.keeper import CalibratorKeeper
from backend.database import Database
from backend.exports import ExportStore
from backend.heartbeat import HeartbeatTeller
from backend.import_jobs import ImportJobs
from backend.live import Hub
from backend.logins import LoginBook
from backend.map3d_in_use import Map3dInUse
from backend.map3d_jobs import Map3dJobs
from backend.map3d_pictures import Map3dPictures
from backend.map3d_store import Map3dStore
from backend.missions import MissionStore
from backend.navigator import NavigatorClient
from backend.nonces import NonceBook
from backend.picture_sites import PictureSites
from backend.picture_store import PictureStore
from backend.placing import Placer
from backend.recorder import RecorderClient
from backend.robot import RobotView
from backend.row_proposals import RowProposals
from backend.run_end import RunEnd
from backend.run_mapper import RunMapper
from backend.run_starter import RunStarter
from backend.run_watcher import RunWatcher
from backend.runs import RunStore
from backend.scene_process import SceneProcess
from backend.settings import Settings
from backend.sites import SiteStore
from backend.stopper import Stopper
from backend.supervisor import SupervisorClient
from backend.trunk_maps import TrunkMapStore
from navcore.transport.endpoints import Endpoints
from navcore.vehicle import PROFILES, VehicleParams


@dataclass(frozen=True, slots=True, kw_only=True)
class Station:
    """What the routes work with. `close` lets go of everything, last made first."""

    settings: Settings
    vehicle: VehicleParams
    logins: LoginBook
    audit: AuditBook
    sites: SiteStore
    missions: MissionStore
    runs: RunStore
    jobs: ImportJobs
    pictures: PictureStore
    picture_sites: PictureSites
    row_proposals: RowProposals
    hub: Hub
    robot: RobotView
    starter: RunStarter
    placer: Placer
    stopper: Stopper
    nonces: NonceBook
    exports: ExportStore
    trunk_maps: TrunkMapStore
    mapper: RunMapper
    maps3d: Map3dStore
    map3d_in_use: Map3dInUse
    map3d_jobs: Map3dJobs
    map3d_pictures: Map3dPictures
    watcher: RunWatcher
    heartbeat: HeartbeatTeller
    scene: SceneProcess
    calibrator: Calibrator
    calibrations: CalibrationVersions
    closers: tuple[Callable[[], None], ...]

    def start(self, loop: asyncio.AbstractEventLoop) -> None:
        """Begin to listen to the robot. Nothing here makes it move."""
        self.hub.open(loop)
        self.watcher.start()
        self.heartbeat.start()
        self.scene.start()
        self.calibrator.start()

    def close(self) -> None:
        """Let go of threads, processes, sockets and the database."""
        for closer in self.closers:
            closer()


def open_station(settings: Settings) -> Station:
    """Open the data folder and wire the parts. Removes what an interrupted import left behind."""
    endpoints = Endpoints(settings.bus_dir)
    endpoints.prepare()
    database = Database(settings.database_path)
    uploads.clear(settings)
    sites, runs = SiteStore(database), RunStore(database, settings.run_dir)
    pictures = PictureStore(settings.orthophoto_dir, settings.tile_dir)
    pictures.delete_all_but(sites.orthophoto_ids())
    hub, audit, jobs = Hub(endpoints), AuditBook(database), ImportJobs(settings)
    navigator, told_to_stop, told_alive = (NavigatorClient(endpoints) for _ in range(3))
    recorder, supervisor = RecorderClient(endpoints), SupervisorClient(endpoints, settings.data_dir / "robot")
    robot = RobotView(settings, hub, supervisor)
    stopper = Stopper(endpoints, told_to_stop)
    exports, trunk_maps = ExportStore(), TrunkMapStore(database, settings.data_dir / "robot")
    mapper = RunMapper(runs, exports, trunk_maps)
    watcher = RunWatcher(endpoints, runs, hub.put, RunEnd(recorder, mapper.map_ended).finish)
    heartbeat = HeartbeatTeller(told_alive, lambda: hub.operators(settings.operator_timeout_s))
    scene = SceneProcess(settings)
    maps3d = Map3dStore(settings.map3d_dir)
    map3d_in_use = Map3dInUse(maps3d, settings.data_dir / "robot")
    map3d_jobs = Map3dJobs(maps3d)
    calibrator = Calibrator(settings, endpoints, CalibratorKeeper(settings), robot)
    clients = (navigator, told_to_stop, told_alive, recorder, supervisor, database)
    return Station(
        settings=settings,
        vehicle=PROFILES[settings.vehicle],
        logins=login_book(database, settings),
        audit=audit,
        sites=sites,
        missions=MissionStore(database),
        runs=runs,
        jobs=jobs,
        pictures=pictures,
        picture_sites=PictureSites(sites, pictures),
        row_proposals=RowProposals(sites),
        hub=hub,
        robot=robot,
        starter=RunStarter(settings, database, runs, audit, navigator, recorder, robot),
        placer=Placer(sites, robot, navigator, audit),
        stopper=stopper,
        nonces=NonceBook(),
        exports=exports,
        trunk_maps=trunk_maps,
        mapper=mapper,
        maps3d=maps3d,
        map3d_in_use=map3d_in_use,
        map3d_jobs=map3d_jobs,
        map3d_pictures=Map3dPictures(maps3d, settings),
        watcher=watcher,
        heartbeat=heartbeat,
        scene=scene,
        calibrator=calibrator,
        calibrations=CalibrationVersions(settings, robot),
        closers=tuple(
            part.close for part in (calibrator, scene, heartbeat, watcher, hub, map3d_jobs, jobs, stopper, *clients)
        ),
    )


def login_book(database: Database, settings: Settings) -> LoginBook:
    """With the lives that the settings give."""
    idle = timedelta(seconds=settings.session_idle_s)
    return LoginBook(database, idle, timedelta(seconds=settings.session_absolute_s))
