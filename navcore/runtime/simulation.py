"""The simulated robot's world as its processes share it: the same seed builds the same orchard in each."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import TYPE_CHECKING

from navcore.geometry.lidar_mount import LidarMount, robot_lidar
from navcore.geometry.pinhole import PinholeCamera, robot_camera
from navcore.maps.site_map import SiteMap
from navcore.messages import CameraName
from navcore.sim.camera_light import LightName, LightParams, named_light
from navcore.sim.orchard import OrchardParams, Season
from navcore.vehicle import VehicleParams

if TYPE_CHECKING:
    from navcore.sim.world import World


def robot_cameras(*, width_px: int = 640, height_px: int = 360) -> dict[CameraName, PinholeCamera]:
    """Front and rear camera of the default robot."""
    return {
        name: robot_camera(rear=name is CameraName.REAR, width_px=width_px, height_px=height_px)
        for name in CameraName
    }


class DetectorKind(StrEnum):
    """PIXELS: the shipped detector on the drawn picture. TRUTH: boxes from the truth, where pixels cost too much."""

    PIXELS = "pixels"
    TRUTH = "truth"


@dataclass(frozen=True, slots=True, kw_only=True)
class SimulationParams:
    """What an operator may choose of the simulated world.

    Attributes:
        world_seed: of everything random; >= 0.
        season: leaves on the canopy. light: sun, clouds, lamp.
        camera_latency_ms: from exposure until the picture is there, 0 to 500; drawing it takes part of that time.
        picture_width_px, picture_height_px: of the drawn pictures; the published 1280 x 720 takes four times as long.
        detector: what finds trunks and posts.
        lidar2d: whether the robot carries a 2D LiDAR, mounted as paper B's.
        lidar3d: whether it carries a 3D LiDAR, mounted as the robot's settings say. Whoever uses its
            turns casts them himself.
    """

    world_seed: int = 1
    season: Season = Season.GROWING
    light: LightName = LightName.AFTERNOON
    camera_latency_ms: int = 60
    picture_width_px: int = 640
    picture_height_px: int = 360
    detector: DetectorKind = DetectorKind.PIXELS
    lidar2d: bool = False
    lidar3d: bool = False

    def world(self, site: SiteMap, vehicle: VehicleParams, start_ns: int) -> World:
        """The world of this simulation."""
        # Here, because whoever starts the processes reads the choices only, and all of them wait for him.
        from navcore.sim.lidar2d import Lidar2dParams
        from navcore.sim.world import World, WorldParams

        orchard = OrchardParams(seed=self.world_seed, season=self.season)
        lidar2d = Lidar2dParams() if self.lidar2d else None
        return World(site, vehicle, WorldParams(seed=self.world_seed, orchard=orchard, lidar2d=lidar2d), start_ns)

    def lidar_mount(self) -> LidarMount:
        """Of the 2D LiDAR."""
        return robot_lidar()

    def mounts(self) -> dict[CameraName, PinholeCamera]:
        """Front and rear camera."""
        return robot_cameras(width_px=self.picture_width_px, height_px=self.picture_height_px)

    def light_params(self) -> LightParams:
        """The light of this simulation."""
        return named_light(self.light, seed=self.world_seed)
