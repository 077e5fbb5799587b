"""Packets to whole turns of the head, each point with its time."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from itertools import accumulate, pairwise
from typing import NamedTuple

import numpy as np

from navcore.drivers.lidar3d.data_packet import TURN_CDEG, DataPacket
from navcore.drivers.lidar3d.models import LidarModel
from navcore.drivers.lidar3d.packet_clock import PacketClock, PacketClockParams, Step
from navcore.drivers.lidar3d.rays import Rays, ends, last_ray_us, packet_us, rays_of
from navcore.drivers.lidar3d.refusals import Refused
from navcore.errors import ConfigError
from navcore.geometry.point_cloud import PointCloud

# Packets of a head that never comes round are not kept for ever.
MOST_PACKETS = 2048
_REFUSED = {Step.REPEATED: Refused.REPEATED, Step.LATE: Refused.LATE}
_BROKEN = {Step.JUMPED: Refused.CLOCK_JUMP, Step.SILENCE: Refused.SILENCE}


@dataclass(frozen=True, slots=True, kw_only=True)
class TurnsParams:
    """Parameters of `Turns`.

    Attributes:
        most_lost: a turn that lost a larger share of its packets is refused; 0 to 0.9.
        clock: how the device's clock is followed.
    """

    most_lost: float = 0.25
    clock: PacketClockParams = PacketClockParams()

    def __post_init__(self) -> None:
        if not 0 <= self.most_lost <= 0.9:
            raise ConfigError(f"most_lost must be 0 to 0.9, but is {self.most_lost}.")


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Turn:
    """One turn of the head.

    Attributes:
        stamp_ns: when its last ray was taken. period_s: from its first ray to that.
        cloud: its echoes in `lidar3d`; their times count from `stamp_ns`.
        lost: packets that were missing in it.
    """

    stamp_ns: int
    period_s: float
    cloud: PointCloud
    lost: int


class _Placed(NamedTuple):
    """A packet, the azimuths of its blocks counted on from turn to turn, and when its first ray was taken."""

    packet: DataPacket
    turned_cdeg: list[int]
    began_us: float


@dataclass(slots=True)
class _Gathered:
    """What came of a turn so far. whole: since its beginning. number: of the turn."""

    placed: list[_Placed] = field(default_factory=list)
    lost: int = 0
    whole: bool = False
    number: int = 0


class Turns:
    """Gathers packets until the head has come round; what came before the first full turn is not told.

    Attributes:
        model: of the LiDAR; a calibrated one may take its place at any time.
        refused: packets and turns by reason, counted on in the one that is handed in. lost: packets, in all.
    """

    def __init__(
        self, model: LidarModel, refused: Counter[Refused] | None = None, params: TurnsParams = TurnsParams()
    ) -> None:
        self.model, self._p = model, params
        self.refused: Counter[Refused] = Counter() if refused is None else refused
        self.lost = 0
        self._clock = PacketClock(model.counter_us, params.clock)
        self._now = _Gathered()

    def add(self, packet: DataPacket, arrived_ns: int) -> Turn | None:
        """The turn that ends in a packet that arrived then, if one does."""
        span_us = last_ray_us(self.model, dual=packet.dual)
        lead_us = 0 if self.model.stamped_at_end else round(span_us)
        before_us = self._clock.us
        step = self._clock.follow(packet.counter_us + lead_us, arrived_ns)
        if step in _REFUSED:
            self.refused[_REFUSED[step]] += 1
            return None
        if step in _BROKEN:
            self._begin_anew(_BROKEN[step])
        elif self._now.placed:
            self._count_lost(self._clock.us - before_us, packet)
        return self._keep(packet, self._clock.us - (lead_us or span_us))

    def _begin_anew(self, reason: Refused) -> None:
        self.refused[reason] += 1
        self._now = _Gathered()

    def _count_lost(self, step_us: int, packet: DataPacket) -> None:
        lost = max(0, round(step_us / packet_us(self.model, dual=packet.dual)) - 1)
        self.lost += lost
        self._now.lost += lost

    def _keep(self, packet: DataPacket, began_us: float) -> Turn | None:
        turned = self._turned_by(packet)
        if not self._now.placed:
            self._now.number = turned[0] // TURN_CDEG
        self._now.placed.append(_Placed(packet, turned, began_us))
        # Rays of the last block lie up to a step behind its azimuth.
        number = (turned[-1] + packet.steps[-1]) // TURN_CDEG
        if number > self._now.number:
            return self._close(number)
        if len(self._now.placed) > MOST_PACKETS:
            self._now = _Gathered()
        return None

    def _turned_by(self, packet: DataPacket) -> list[int]:
        """Azimuths of its blocks, counted on from turn to turn."""
        if self._now.placed and packet.dual != self._now.placed[-1].packet.dual:
            self._now = _Gathered()
        if not self._now.placed:
            return _counted_on(packet.azimuths[0], packet.azimuths)
        before = self._now.placed[-1].turned_cdeg[-1]
        step = (packet.azimuths[0] - before) % TURN_CDEG
        if step > TURN_CDEG // 2:
            self._begin_anew(Refused.AZIMUTH_BACK)
            return _counted_on(packet.azimuths[0], packet.azimuths)
        return _counted_on(before + step, packet.azimuths)

    def _close(self, number: int) -> Turn | None:
        """The turn before `number`; None if its beginning was not seen or too much of it was lost."""
        done = self._now
        self._now = _Gathered(placed=done.placed[-1:], whole=True, number=number)
        if not done.whole:
            return None
        if done.lost > self._p.most_lost * (done.lost + len(done.placed)):
            self.refused[Refused.TORN_TURN] += 1
            return None
        return self._turn(done)

    def _turn(self, done: _Gathered) -> Turn:
        packets, turned, began_us = zip(*done.placed, strict=True)
        rays = rays_of(packets, np.array(turned) / 100.0, np.array(began_us), self.model)
        rays = rays.where(np.floor(rays.turned_deg / 360.0) == done.number)
        end_us = float(rays.us[-1])
        return Turn(
            stamp_ns=self._clock.stamp_ns(end_us), period_s=(end_us - float(rays.us[0])) * 1e-6,
            cloud=self._cloud(rays, end_us), lost=done.lost,
        )  # fmt: skip

    def _cloud(self, rays: Rays, end_us: float) -> PointCloud:
        echoes = rays.where((rays.distance > self.model.nearest) & (rays.distance <= self.model.farthest))
        return PointCloud(
            points=ends(echoes, self.model), times=(echoes.us - end_us) * 1e-6, intensities=echoes.intensity,
            rings=self.model.rings()[echoes.channel],
        )  # fmt: skip


def _counted_on(first: int, azimuths: tuple[int, ...]) -> list[int]:
    """Azimuths that begin with `first`."""
    steps = ((azimuth - before) % TURN_CDEG for before, azimuth in pairwise(azimuths))
    return list(accumulate(steps, initial=first))
