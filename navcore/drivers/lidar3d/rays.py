"""Blocks of many packets to rays: direction, time, distance; and where their echoes lie."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.drivers.lidar3d.data_packet import BLOCKS, DataPacket
from navcore.drivers.lidar3d.models import CHANNELS, FIRINGS, LidarModel

Floats = NDArray[np.float64]
_ECHO = np.dtype([("distance", "<u2"), ("intensity", "u1")])
BLOCK = np.dtype([("flag", "<u2"), ("azimuth", "<u2"), ("echoes", _ECHO, (FIRINGS, CHANNELS))])


class Rays(NamedTuple):
    """In the order in which they were taken; of two echoes of one ray the second follows the first.

    Attributes:
        turned_deg: (N,) clockwise, counted on from turn to turn.
        us: (N,) when each was taken.
        distance: (N,) m, 0 where nothing came back, or the same twice. intensity: (N,) uint8.
        channel: (N,) in the order of firing.
    """

    turned_deg: Floats
    us: Floats
    distance: Floats
    intensity: NDArray[np.uint8]
    channel: NDArray[np.intp]

    def where(self, kept: NDArray[np.bool_]) -> Rays:
        """Some of them."""
        turned, us, distance, intensity, channel = self
        return Rays(turned[kept], us[kept], distance[kept], intensity[kept], channel[kept])


def rays_of(packets: Sequence[DataPacket], turned_deg: Floats, began_us: Floats, model: LidarModel) -> Rays:
    """All rays of packets (P,) of one return mode.

    Args:
        turned_deg: (P, 12) of each block's first ray. began_us: (P,) of each packet's.
    """
    echoes = 2 if packets[0].dual else 1
    groups = BLOCKS // echoes
    blocks = np.frombuffer(b"".join(packet.blocks for packet in packets), BLOCK)
    # Packet, group of blocks that tell of the same rays, firing, channel, echo.
    told = blocks["echoes"].reshape(-1, groups, echoes, FIRINGS, CHANNELS).transpose(0, 1, 3, 4, 2)
    shape = told.shape
    in_block = ray_us(model)
    us = began_us[:, None, None, None] + model.block_us * np.arange(groups)[:, None, None] + in_block
    first = turned_deg[:, ::echoes]
    turned = first[..., None, None] + _steps(first)[..., None, None] * (in_block / model.block_us)
    return Rays(
        np.broadcast_to(turned[..., None], shape).ravel(), np.broadcast_to(us[..., None], shape).ravel(),
        _distances(told["distance"]).ravel() * model.unit, told["intensity"].ravel(),
        np.broadcast_to(np.arange(CHANNELS)[:, None], shape).ravel(),
    )  # fmt: skip


def packet_us(model: LidarModel, *, dual: bool) -> float:
    """From one packet to the next."""
    return model.block_us * (BLOCKS // 2 if dual else BLOCKS)


def last_ray_us(model: LidarModel, *, dual: bool) -> float:
    """From a packet's first ray to its last one."""
    return packet_us(model, dual=dual) - model.block_us + float(ray_us(model)[-1, -1])


def ray_us(model: LidarModel) -> Floats:
    """(2, 16) from a block's first ray to each."""
    firing, channel = np.arange(FIRINGS)[:, None], np.arange(CHANNELS)
    return np.asarray(firing * model.firing_us + channel * model.channel_us)


def _steps(turned: Floats) -> Floats:
    """How far the head turns from each block to the next; after a packet's last one as before it."""
    steps = np.diff(turned, axis=1)
    return np.concatenate((steps, steps[:, -1:]), axis=1)


def _distances(told: NDArray[np.uint16]) -> Floats:
    """A ray with one echo tells it twice in dual mode; it counts once."""
    distances = told.astype(np.float64)
    if told.shape[-1] == 2:
        distances[..., 1] *= told[..., 0] != told[..., 1]
    return distances


def ends(rays: Rays, model: LidarModel) -> Floats:
    """Where rays end, (N, 3) in `lidar3d` (x where the azimuth is 0, y left, z up), m.

    A C16's rays leave its head beside the axis, `lever` away and `lever_deg` from the ray.
    """
    azimuth, vertical = np.radians(rays.turned_deg), np.radians(model.vertical_deg)
    flat = rays.distance * np.cos(vertical)[rays.channel]
    x, y = flat * np.cos(azimuth), -flat * np.sin(azimuth)
    if model.lever:
        beside = np.radians(model.lever_deg) - azimuth
        x, y = x + model.lever * np.cos(beside), y + model.lever * np.sin(beside)
    height = np.asarray(model.height_mm)[rays.channel] * 1e-3
    return np.column_stack((x, y, rays.distance * np.sin(vertical)[rays.channel] + height))
