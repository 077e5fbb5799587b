"""Composes every module's own parameters into one tree; a run keeps the tree it used."""

from __future__ import annotations

import dataclasses
import tomllib
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any, get_type_hints

import msgspec

from navcore.control.tracking import TrackerName
from navcore.drivers.camera_capture import CameraParams
from navcore.drivers.lidar3d.lidar3d_params import Lidar3dParams
from navcore.drivers.rplidar.lidar_params import LidarParams
from navcore.errors import ConfigError
from navcore.geometry.pinhole import robot_camera
from navcore.maps.site_map import Datum
from navcore.messages import CameraName
from navcore.navigator import Navigator, NavigatorParams
from navcore.perception.detector import DetectorParams
from navcore.perception.plants.scan_eye import ScanEyeParams
from navcore.perception.row_perception import RowPerceptionParams
from navcore.vehicle import PROFILES, VehicleParams


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotConfig:
    """All that is set on one robot.

    Attributes:
        vehicle: name of a profile in `vehicle.PROFILES`.
        front_camera, rear_camera: of a real robot; a simulated one has paper A's.
        lidar: a 2D LiDAR, if there is one; a simulated robot has one if its simulation says so. scan: how plants are
            followed in its scans.
        lidar3d: a 3D LiDAR, if there is one.
        detector: of trunks and posts.
    """

    vehicle: str = "paper_a"
    front_camera: CameraParams = field(default_factory=CameraParams)
    rear_camera: CameraParams = field(default_factory=lambda: CameraParams(mount=robot_camera(rear=True)))
    lidar: LidarParams = field(default_factory=LidarParams)
    lidar3d: Lidar3dParams = field(default_factory=Lidar3dParams)
    scan: ScanEyeParams = field(default_factory=ScanEyeParams)
    detector: DetectorParams = field(default_factory=DetectorParams)
    navigator: NavigatorParams = field(default_factory=NavigatorParams)
    perception: RowPerceptionParams = field(default_factory=RowPerceptionParams)

    def vehicle_params(self) -> VehicleParams:
        """The profile. Raises ConfigError for an unknown name."""
        if self.vehicle not in PROFILES:
            raise ConfigError(f"There is no vehicle '{self.vehicle}'. Known are: {', '.join(PROFILES)}.")
        return PROFILES[self.vehicle]

    def cameras(self) -> dict[CameraName, CameraParams]:
        """Both cameras by name."""
        return {CameraName.FRONT: self.front_camera, CameraName.REAR: self.rear_camera}

    def new_navigator(self, datum: Datum) -> Navigator:
        """A navigator for a site with this datum."""
        vehicle = self.vehicle_params()
        return Navigator(datum, _with_antenna(self.navigator, vehicle), vehicle)


def _with_antenna(params: NavigatorParams, vehicle: VehicleParams) -> NavigatorParams:
    """Where the antenna stands is a fact of the vehicle, told to all who need it."""
    x, y = vehicle.antenna_x, vehicle.antenna_y
    gnss = dataclasses.replace(params.filter.gnss, antenna_x=x, antenna_y=y)
    return dataclasses.replace(
        params,
        filter=dataclasses.replace(params.filter, gnss=gnss),
        check=dataclasses.replace(params.check, antenna_x=x, antenna_y=y),
        on_map=dataclasses.replace(params.on_map, antenna_x=x, antenna_y=y),
    )


def load_config(path: Path) -> RobotConfig:
    """Read a TOML file; what it leaves out keeps its default. Raises ConfigError with the key and the reason."""
    try:
        tree = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise ConfigError(f"Cannot read the settings in {path.name}: {error}") from error
    return config_from_tree(tree)


def config_from_tree(tree: dict[str, Any]) -> RobotConfig:
    """Settings from plain data; unknown keys and wrong types are refused by name."""
    _refuse_unknown(tree, RobotConfig, "")
    try:
        return msgspec.convert(tree, RobotConfig)
    except msgspec.ValidationError as error:
        raise ConfigError(f"The settings are not usable: {error}") from error


def config_of_run(tree: dict[str, Any]) -> RobotConfig:
    """Settings that a run was driven with, from its log: a choice that it did not know yet was made as of then.

    Raises ConfigError as `config_from_tree`.
    """
    navigator = tree.get("navigator", {}) if isinstance(tree, dict) else None
    driver = navigator.get("driver", {}) if isinstance(navigator, dict) else None
    if not isinstance(driver, dict) or "tracking" in driver:
        return config_from_tree(tree)
    then = {**driver, "tracking": {"name": TrackerName.LINE.value}}
    return config_from_tree({**tree, "navigator": {**navigator, "driver": then}})


def config_to_tree(config: RobotConfig) -> dict[str, Any]:
    """Plain data for the run's log."""
    tree: dict[str, Any] = msgspec.to_builtins(config)
    return tree


def _refuse_unknown(tree: Any, cls: type, where: str) -> None:
    if not isinstance(tree, dict):
        raise ConfigError(f"'{where}' must be a table of settings.")
    types = get_type_hints(cls)
    for key, value in tree.items():
        if key not in types:
            raise ConfigError(f"Unknown setting '{where}{key}'. Known are: {', '.join(types)}.")
        _refuse_unnamed(value, types[key], f"{where}{key}")
        if dataclasses.is_dataclass(types[key]) and isinstance(types[key], type):
            _refuse_unknown(value, types[key], f"{where}{key}.")


def _refuse_unnamed(value: Any, kind: Any, where: str) -> None:
    """A choice by name must name one of the choices."""
    if isinstance(kind, type) and issubclass(kind, StrEnum) and value not in list(kind):
        raise ConfigError(f"There is no '{value}' for '{where}'. Known are: {', '.join(kind)}.")
