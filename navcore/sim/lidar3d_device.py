"""A simulated VLP-16 or C16, byte for byte: the datagrams that it sends of what stands around it."""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta

import numpy as np

from navcore.drivers.lidar3d.data_packet import BLOCKS, DUAL, SINGLE, TURN_CDEG, VLP16_FACTORY
from navcore.drivers.lidar3d.device_packets import DEVICE_BYTES, DEVICE_HEAD
from navcore.drivers.lidar3d.models import C16, CHANNELS, LidarModel, ModelName
from navcore.drivers.lidar3d.rays import BLOCK, Floats, last_ray_us, packet_us, ray_us
from navcore.geometry.point_cloud import PointCloud
from navcore.sim.lidar3d_beams import Beams, Echoes
from navcore.sim.lidar3d_sweep import firing_step_deg

# The cloud of each turn, counted from 0.
TurnMaker = Callable[[int], PointCloud]
BEGAN = datetime(2026, 5, 1, 10, 0, tzinfo=UTC)
_C16_FACTORY = 0x10
_DEVICE_EVERY_US = 1_000_000.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Lidar3dDeviceParams:
    """Parameters of `Lidar3dDevice`.

    Attributes:
        model: of the LiDAR. rpm: of its head, 300 to 1200.
        dual: it sends two echoes of each ray. long: a C16's packets of 1212 bytes, with date and time.
    """

    model: LidarModel = C16
    rpm: float = 600.0
    dual: bool = False
    long: bool = False


class Lidar3dDevice:
    """Sends `make`'s points as the beams that meet them would be told; `us` is its time since it was switched on.

    Points between its beams come back in the nearest beam's direction.
    """

    def __init__(self, make: TurnMaker, params: Lidar3dDeviceParams = Lidar3dDeviceParams()) -> None:
        self._make, self._p = make, params
        self._beams: dict[int, Beams] = {}
        self._owed_us = 0.0
        self._told_us = -_DEVICE_EVERY_US
        self.us = 0.0

    def run(self, seconds: float) -> list[bytes]:
        """The datagrams of that time, those of its own device port among them."""
        sent, each_us = [], packet_us(self._p.model, dual=self._p.dual)
        self._owed_us += seconds * 1e6
        while self._owed_us >= each_us:
            if self._p.model.name is not ModelName.VLP16 and self.us - self._told_us >= _DEVICE_EVERY_US:
                sent.append(self._device_packet())
                self._told_us = self.us
            sent.append(self._blocks() + self._tail())
            self.us += each_us
            self._owed_us -= each_us
        return sent

    def _blocks(self) -> bytes:
        """In dual mode the last echoes come in even blocks and the strongest, here the nearest, in odd ones."""
        model, together = self._p.model, 2 if self._p.dual else 1
        groups = np.arange(BLOCKS // together) * model.block_us
        turned = (self.us + groups[:, None, None] + ray_us(model)) * self._p.rpm * 6e-6
        distance, intensity = self._echoes(turned)
        told = np.zeros((BLOCKS // together, together), BLOCK)
        told["flag"] = 0xEEFF
        told["azimuth"] = np.round(turned[:, :1, 0] * 100.0).astype(np.int64) % TURN_CDEG
        counts = np.round(distance / model.unit)
        for echo in range(together):
            shown = 1 - echo if self._p.dual else 0
            told["echoes"]["distance"][:, echo] = counts[..., shown]
            told["echoes"]["intensity"][:, echo] = intensity[..., shown]
        return told.tobytes()

    def _echoes(self, turned_deg: Floats) -> Echoes:
        """Of rays (..., 16), which may belong to two turns."""
        channel, half = np.arange(CHANNELS), firing_step_deg(self._p.model, self._p.rpm) / 2.0
        number = np.floor(turned_deg / 360.0).astype(np.int64)
        found = [self._turn(k).echoes(channel, turned_deg % 360.0, half) for k in np.unique(number).tolist()]
        new, before, after = (number == number.max())[..., None], found[0], found[-1]
        return Echoes(
            np.where(new, after.distance, before.distance), np.where(new, after.intensity, before.intensity)
        )

    def _turn(self, number: int) -> Beams:
        if number not in self._beams:
            self._beams = {k: v for k, v in self._beams.items() if k == number - 1}
            self._beams[number] = Beams(self._make(number), self._p.model)
        return self._beams[number]

    def _tail(self) -> bytes:
        model, mode = self._p.model, DUAL if self._p.dual else SINGLE
        stamp_us = self.us + (last_ray_us(model, dual=self._p.dual) if model.stamped_at_end else 0.0)
        counter = round(stamp_us) % model.counter_us
        if self._p.long:
            return self._date(stamp_us) + struct.pack("<IBB", counter, mode, _C16_FACTORY)
        factory = VLP16_FACTORY if model.name is ModelName.VLP16 else _C16_FACTORY
        return struct.pack("<IBB", counter, mode, factory)

    def _date(self, us: float) -> bytes:
        now = BEGAN + timedelta(microseconds=round(us))
        return bytes((now.year - 2000, now.month, now.day, now.hour, now.minute, now.second))

    def _device_packet(self) -> bytes:
        """Its second version, with the beams' angles as they are."""
        data = bytearray(DEVICE_BYTES)
        data[:4] = DEVICE_HEAD
        struct.pack_into(">H", data, 8, round(self._p.rpm))
        data[36:42] = self._date(self.us)
        struct.pack_into(f">{CHANNELS}h", data, 234, *(round(angle * 100.0) for angle in self._p.model.vertical_deg))
        data[1202] = 2
        return bytes(data)
