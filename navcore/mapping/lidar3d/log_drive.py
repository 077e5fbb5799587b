"""A drive from the log of a run."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

from navcore.config import RobotConfig, config_from_tree
from navcore.errors import LogError
from navcore.geometry.lidar_mount import LidarMount
from navcore.mapping.lidar3d.drive import Drive, Rig, Sensed
from navcore.maps.site_map import Datum
from navcore.messages import NavInputs, NavPrelude
from navcore.messages.cloud import LidarCloud
from navcore.recording.message_count import message_count
from navcore.recording.reader import read_farm, read_log, read_metadata, read_prelude
from navcore.topics import LIDAR3D_CLOUD, NAV_INPUTS
from navcore.transport.codec import decode


def log_drive(log: Path, mount: LidarMount | None = None) -> Drive:
    """The drive that a run log holds; `mount` in the place of the one that the robot was set up with.

    Raises LogError if `log` is no run log; its messages are read as the drive is.
    """
    name = read_metadata(log).get("run_id") or log.stem
    prelude = read_prelude(log)
    config = _config(prelude)
    vehicle = config.vehicle_params()
    antenna = (vehicle.antenna_x, vehicle.antenna_y, vehicle.antenna_height)
    rig = Rig(lidar=mount or config.lidar3d.mount, antenna=antenna)
    clouds = message_count(log, LIDAR3D_CLOUD.name)
    return Drive(name=name, rig=rig, datum=_datum(log, prelude), sensed=lambda: _sensed(log), clouds=clouds)


def _sensed(log: Path) -> Iterator[Sensed]:
    """As recorded. Raises LogError, and InputError for a message of another version."""
    for message in read_log(log, (NAV_INPUTS.name, LIDAR3D_CLOUD.name)):
        if message.name == NAV_INPUTS.name:
            yield decode(NavInputs, message.payload)
        else:
            yield decode(LidarCloud, message.payload)


def _config(prelude: NavPrelude | None) -> RobotConfig:
    """Of the robot; the defaults where the log does not tell."""
    if prelude is None:
        return RobotConfig()
    try:
        return config_from_tree(json.loads(prelude.config))
    except ValueError as error:
        raise LogError("The log does not tell how its robot was set up; its settings are no JSON.") from error


def _datum(log: Path, prelude: NavPrelude | None) -> Datum | None:
    try:
        return read_farm(log).datum
    except LogError:
        if prelude is None:
            return None
    lat, lon, height = prelude.datum
    return Datum(lat_deg=lat, lon_deg=lon, height_m=height)
