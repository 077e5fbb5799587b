"""What stands around a 3D LiDAR, and the datagrams that it sends of that."""

from __future__ import annotations

import functools

import numpy as np
from numpy.typing import NDArray

from navcore.drivers.lidar3d.models import MODELS, LidarModel, ModelName
from navcore.drivers.lidar3d.rays import packet_us
from navcore.drivers.lidar3d.stream import LidarStream
from navcore.drivers.lidar3d.turns import Turn
from navcore.geometry.point_cloud import PointCloud
from navcore.sim.lidar3d_device import Lidar3dDevice, Lidar3dDeviceParams
from navcore.sim.lidar3d_sweep import swept_cloud

Floats = NDArray[np.float64]
# A room: front, back, left, right, ceiling, floor, m from the sensor.
WALLS = np.array(((5.0, -3.0), (2.0, -3.0), (1.5, -1.2)))
BEGAN_NS = 5_000_000_000_000


def room(origins: Floats, directions: Floats, _times: Floats) -> Floats:
    """Distances, m, to the walls."""
    with np.errstate(divide="ignore"):
        to_walls = (np.where(directions > 0.0, WALLS[:, 0], WALLS[:, 1]) - origins) / directions
    return np.asarray(np.where(directions == 0.0, np.inf, to_walls).min(axis=1))


def off_walls(cloud: PointCloud) -> Floats:
    """How far each point lies from the nearest wall, m."""
    return np.asarray(np.abs(cloud.points[:, :, None] - WALLS).min(axis=(1, 2)))


@functools.cache
def room_cloud(name: ModelName) -> PointCloud:
    return swept_cloud(room, MODELS[name])


@functools.cache
def datagrams(name: ModelName, *, dual: bool = False, long: bool = False, seconds: float = 0.33) -> tuple[bytes, ...]:
    """Of so many seconds in the room."""
    params = Lidar3dDeviceParams(model=MODELS[name], dual=dual, long=long)
    return tuple(Lidar3dDevice(lambda _: room_cloud(name), params).run(seconds))


def arrivals(model: LidarModel, sent: tuple[bytes, ...], *, dual: bool = False) -> list[tuple[bytes, int]]:
    """Each with the time at which it comes, ns: evenly, a device packet together with the next one."""
    at, found = float(BEGAN_NS), []
    for data in sent:
        found.append((data, round(at)))
        at += packet_us(model, dual=dual) * 1000.0 if data.startswith(b"\xff\xee") else 0.0
    return found


def fed(stream: LidarStream, coming: list[tuple[bytes, int]]) -> list[Turn]:
    """Turns that come of it."""
    turns = (stream.feed(data, at) for data, at in coming)
    return [turn for turn in turns if turn is not None]
