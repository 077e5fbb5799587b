"""What stands in the 3D view, and how it moves. Frame: `map`, z up."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from viser import ViserServer

from backend.scene_cells import Cells, show_cells
from backend.scene_site import show_site
from backend.scene_trunks import show_trunks, unmapped
from navcore.geometry.geodesy import EnuFrame
from navcore.geometry.se2 import SE2
from navcore.maps.site_map import SiteMap
from navcore.maps.trunk_map import TrunkMap
from navcore.messages import (
    CameraName,
    Ghost,
    GhostSource,
    GnssFix,
    MissionPlan,
    NavStatus,
    PoseEstimate,
    RowObservation,
    SimTruth,
)
from navcore.vehicle import VehicleParams

Floats = NDArray[np.float32]
GREEN, ORANGE, BLUE, GREY, RED, VIOLET = (
    (38, 140, 76), (235, 130, 30), (40, 110, 220), (130, 130, 130), (210, 50, 50), (140, 80, 190),
)  # fmt: skip
GHOST_COLOURS = {
    GhostSource.GNSS: RED, GhostSource.ODOMETRY: GREY, GhostSource.ROWS: VIOLET, GhostSource.MAP: BLUE,
}  # fmt: skip
GHOST_WORDS = {
    GhostSource.GNSS: "GNSS", GhostSource.ODOMETRY: "odometry", GhostSource.ROWS: "rows", GhostSource.MAP: "3D map",
}  # fmt: skip
DRIVEN_STEP = 0.2  # m between two points of the driven line
MOST_DRIVEN = 5000
ROW_AHEAD = 6.0  # m that a seen row is drawn ahead when its end is not in sight
ELLIPSE_SIGMAS = 2.45  # 95 % of a normal distribution in the plane
BEHIND, UP, AHEAD = 7.0, 4.5, 4.0  # m, the first camera behind the robot, and the point that it looks at
NEW_VIEW_STEP = 1.0  # m
ABOVE = 0.05  # m, so that lines do not flicker in the ground


class SceneView:
    """Takes the bus' messages and keeps the scene as they say."""

    def __init__(self, server: ViserServer, vehicle: VehicleParams) -> None:
        """`vehicle` gives the body's size."""
        self._scene = scene = server.scene
        self._camera = server.initial_camera
        self._seen_from: tuple[float, float] | None = None
        self._vehicle = vehicle
        self._frame: EnuFrame | None = None
        self._driven: list[tuple[float, float]] = []
        self._run_id: str | None = None
        self._pose: PoseEstimate | None = None
        self._shown: dict[type, Callable[[Any], None]] = {
            NavStatus: self._show_status,
            MissionPlan: self._show_plan,
            GnssFix: self._show_fix,
            RowObservation: self._show_row,
            SimTruth: self._show_truth,
        }
        scene.set_up_direction("+z")
        scene.add_grid("/ground", width=400.0, height=400.0, cell_size=5.0, section_size=25.0, infinite_grid=True)

    def show(self, message: Any) -> None:
        """Draw one message; kinds that have no place in the scene are passed over."""
        show = self._shown.get(type(message))
        if show is not None:
            show(message)

    def show_farm(self, site: SiteMap, trunks: TrunkMap, cells: Cells | None = None) -> None:
        """Draw the farm, the trunks that are mapped, and the 3D map that the robot drives by, where there are any."""
        self._frame = EnuFrame(site.datum)
        show_site(self._scene, site, planted=unmapped(site.rows, trunks))
        show_trunks(self._scene, trunks)
        show_cells(self._scene, cells)

    def _show_status(self, status: NavStatus) -> None:
        if status.run_id != self._run_id:
            self._run_id, self._driven = status.run_id, []
        if status.pose is None:
            return
        self._pose = status.pose
        self._body("/robot", status.pose, GREEN, opacity=1.0)
        self._ellipse("/robot_covariance", status.pose.x, status.pose.y, plane_covariance(status.pose), GREEN)
        self._add_driven(status.pose.x, status.pose.y)
        self._show_ghosts(status.ghosts)
        self._stand_behind(status.pose)

    def _show_ghosts(self, ghosts: tuple[Ghost, ...]) -> None:
        """Where each source alone puts the robot, with how far that is from the driven pose."""
        for source in GHOST_COLOURS.keys() - {ghost.source for ghost in ghosts}:
            self._scene.remove_by_name(f"/ghosts/{source.value}")
        for ghost in ghosts:
            name, top = f"/ghosts/{ghost.source.value}", (ghost.x, ghost.y, self._vehicle.height + 0.4)
            self._scene.add_icosphere(name, radius=0.1, color=GHOST_COLOURS[ghost.source], position=top)
            words = f"{GHOST_WORDS[ghost.source]} {100 * ghost.apart:.0f} cm"
            self._scene.add_label(f"{name}/words", words, position=(0.0, 0.0, 0.3))

    def _stand_behind(self, pose: PoseEstimate) -> None:
        """Where a view that is opened from now on begins; views that are open keep the operator's own choice."""
        if self._seen_from is not None and math.dist(self._seen_from, (pose.x, pose.y)) < NEW_VIEW_STEP:
            return
        self._seen_from = (pose.x, pose.y)
        place = SE2(pose.x, pose.y, pose.yaw).apply(np.array([[-BEHIND, 0.0], [AHEAD, 0.0]]))
        self._camera.position = (*place[0], UP)
        self._camera.look_at = (*place[1], 0.0)

    def _add_driven(self, x: float, y: float) -> None:
        if self._driven and math.dist(self._driven[-1], (x, y)) < DRIVEN_STEP:
            return
        self._driven = [*self._driven, (x, y)][-MOST_DRIVEN:]
        self._line("/driven", np.array(self._driven), ORANGE, ABOVE * 2)

    def _show_plan(self, plan: MissionPlan) -> None:
        self._frame = EnuFrame(plan.datum)
        self._scene.remove_by_name("/plan")
        for i, segment in enumerate(plan.segments):
            self._line(f"/plan/{i}", np.array(segment.points), BLUE, ABOVE)

    def _show_fix(self, fix: GnssFix) -> None:
        """Ghost of GNSS alone: the antenna's place and its own 95 % ellipse."""
        if self._frame is None or fix.lat_deg is None or fix.lon_deg is None:
            return
        e, n, _ = self._frame.to_enu(fix.lat_deg, fix.lon_deg, fix.height_m or 0.0)
        self._scene.add_icosphere("/gnss", radius=0.12, color=RED, position=(e, n, self._vehicle.height))
        if fix.std_east_m is not None and fix.std_north_m is not None:
            self._ellipse("/gnss_covariance", e, n, np.diag([fix.std_east_m**2, fix.std_north_m**2]), RED)

    def _show_row(self, row: RowObservation) -> None:
        """The centre line as seen, and the lines of plants beside it, in front of where the robot believes to be."""
        self._scene.remove_by_name("/seen")
        if not row.valid or self._pose is None or row.offset is None or row.heading is None:
            return
        T_map_drive = driving_pose(self._pose, row.camera)
        length = row.end_distance if row.end_distance is not None else ROW_AHEAD
        centre = T_map_drive.apply(line_ahead(row.offset, row.heading, length))
        self._line("/seen/centre", centre, VIOLET, ABOVE * 3)
        if row.width is not None:
            for side, line in enumerate(beside(centre, row.width / 2.0)):
                self._line(f"/seen/side_{side}", line, VIOLET, 0.5)

    def _show_truth(self, truth: SimTruth) -> None:
        """Ghost of where the simulated robot really is."""
        self._body("/ghosts/truth", truth, GREY, opacity=0.35)

    def _body(self, name: str, pose: PoseEstimate | SimTruth, colour: tuple[int, int, int], opacity: float) -> None:
        body = self._vehicle
        self._scene.add_box(
            name,
            color=colour,
            dimensions=(body.length, body.width, body.height),
            opacity=opacity,
            wxyz=(math.cos(pose.yaw / 2.0), 0.0, 0.0, math.sin(pose.yaw / 2.0)),
            position=(pose.x, pose.y, body.height / 2.0),
        )

    def _line(self, name: str, points: NDArray[np.float64], colour: tuple[int, int, int], z: float) -> None:
        segments = as_segments(points, z)
        if len(segments):
            self._scene.add_line_segments(name, points=segments, colors=colour, thickness=0.05)

    def _ellipse(
        self, name: str, x: float, y: float, covariance: NDArray[np.float64], colour: tuple[int, int, int]
    ) -> None:
        self._line(name, ellipse(x, y, covariance), colour, ABOVE)


def as_segments(points: NDArray[np.float64], z: float) -> Floats:
    """(N, 2) points of a line to (N - 1, 2, 3) segments at height `z`."""
    lifted = np.column_stack([points, np.full(len(points), z)]).astype(np.float32)
    return np.stack([lifted[:-1], lifted[1:]], axis=1)


def beside(line: NDArray[np.float64], distance: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """A straight (N, 2) line moved to its left and to its right."""
    along = line[-1] - line[0]
    normal = np.array([-along[1], along[0]]) / max(float(np.hypot(*along)), 1e-9)
    return line + distance * normal, line - distance * normal


def line_ahead(offset: float, heading: float, length: float) -> NDArray[np.float64]:
    """Two points of a line in the driving frame, from its foot at the origin on; offset in m to the left, rad."""
    foot = offset * np.array([-math.sin(heading), math.cos(heading)])
    return np.stack([foot, foot + length * np.array([math.cos(heading), math.sin(heading)])])


def driving_pose(pose: PoseEstimate, camera: CameraName) -> SE2:
    """T_map_drive: `base_link`, turned by pi for the rear camera."""
    return SE2(pose.x, pose.y, pose.yaw) @ SE2(0.0, 0.0, math.pi if camera is CameraName.REAR else 0.0)


def plane_covariance(pose: PoseEstimate) -> NDArray[np.float64]:
    """Of (x, y), 2 x 2, m^2."""
    return np.array(pose.covariance, np.float64).reshape(3, 3)[:2, :2]


def ellipse(x: float, y: float, covariance: NDArray[np.float64], points: int = 37) -> NDArray[np.float64]:
    """Closed (points, 2) outline that holds 95 % of a normal distribution."""
    values, vectors = np.linalg.eigh(covariance)
    angle = np.linspace(0.0, 2.0 * math.pi, points)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    axes = ELLIPSE_SIGMAS * np.sqrt(np.maximum(values, 0.0))
    return np.asarray([x, y] + (circle * axes) @ vectors.T, np.float64)
