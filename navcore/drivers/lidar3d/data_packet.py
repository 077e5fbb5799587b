"""One data packet: twelve blocks of two firings, the device's clock and its return mode (little-endian).

A block is FF EE, the azimuth in hundredths of a degree, and 2 x 16 echoes of a distance and an intensity.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from itertools import pairwise

from navcore.drivers.lidar3d.models import LidarModel, ModelName
from navcore.drivers.lidar3d.refusals import Refused

BLOCKS, BLOCK_BYTES = 12, 100
BLOCKS_BYTES = BLOCKS * BLOCK_BYTES
SHORT_BYTES, LONG_BYTES = 1206, 1212
TURN_CDEG = 36_000
SINGLE, LAST, DUAL = 0x37, 0x38, 0x39
# No head turns faster than 1200 rpm, 0.8 deg from block to block; the rest is jitter.
MOST_STEP_CDEG = 200
VELODYNE = {0x21: "HDL-32E", 0x22: "VLP-16", 0x24: "Puck Hi-Res", 0x28: "VLP-32C", 0x31: "Velarray", 0xA1: "VLS-128"}
VLP16_FACTORY = 0x22
_FLAGS = (b"\xff" * BLOCKS, b"\xee" * BLOCKS)
_AZIMUTHS = struct.Struct("<" + "2xH96x" * BLOCKS)


@dataclass(frozen=True, slots=True)
class DataPacket:
    """Attributes:
    blocks: 1200 bytes. azimuths: of the blocks, clockwise, hundredths of a degree.
    dual: pairs of blocks hold two echoes of the same rays.
    counter_us: the device's clock. utc: its date and time to the second, where the packet holds one.
    """

    blocks: bytes
    azimuths: tuple[int, ...]
    dual: bool
    counter_us: int
    utc: datetime | None = None

    @property
    def steps(self) -> list[int]:
        """From each direction to the next, hundredths of a degree; two echoes of one ray count once."""
        each = self.azimuths[:: 2 if self.dual else 1]
        return [(b - a) % TURN_CDEG for a, b in pairwise(each)]


def open_packet(data: bytes, model: LidarModel) -> DataPacket | Refused:
    """A packet's blocks, or why it holds none."""
    wrong = _no_blocks(data)
    if wrong is not None:
        return wrong
    if contradiction(data, model):
        return Refused.OTHER_MODEL
    mode = data[-2]
    if mode not in (SINGLE, LAST, DUAL):
        return Refused.FOREIGN
    packet = _opened(data, mode == DUAL)
    return packet if _turns_evenly(packet) else Refused.AZIMUTH


def is_data(data: bytes) -> bool:
    """Whether it holds blocks of a LiDAR, whichever."""
    return _no_blocks(data) is None


def _no_blocks(data: bytes) -> Refused | None:
    if len(data) not in (SHORT_BYTES, LONG_BYTES):
        return Refused.SHORT if data.startswith(b"\xff\xee") else Refused.FOREIGN
    flags = (data[0:BLOCKS_BYTES:BLOCK_BYTES], data[1:BLOCKS_BYTES:BLOCK_BYTES])
    return None if flags == _FLAGS else Refused.FOREIGN


def told_model(data: bytes) -> str:
    """The Velodyne that a data packet says it comes from; empty where it says nothing of that kind."""
    return VELODYNE.get(data[-1], "") if len(data) == SHORT_BYTES else ""


def contradiction(data: bytes, model: LidarModel) -> str:
    """A sentence for the operator if a data packet cannot be of that model, else empty."""
    told = told_model(data)
    if model.name is not ModelName.VLP16:
        return "" if told != VELODYNE[VLP16_FACTORY] else _says(f"a Velodyne {told}", model)
    if len(data) == LONG_BYTES:
        return _says("a Leishen C16, by their length", model)
    if data[-1] != VLP16_FACTORY:
        return _says(f"a Velodyne {told}" if told else "a LiDAR of another maker", model)
    return ""


def _says(told: str, model: LidarModel) -> str:
    return f"The packets come from {told}, but the LiDAR is set to be a {model.title}. Correct its model."


def _opened(data: bytes, dual: bool) -> DataPacket:
    blocks, azimuths = data[:BLOCKS_BYTES], _AZIMUTHS.unpack_from(data)
    if len(data) == SHORT_BYTES:
        return DataPacket(blocks, azimuths, dual, struct.unpack_from("<I", data, BLOCKS_BYTES)[0])
    *date, counter_us = struct.unpack_from("<6BI", data, BLOCKS_BYTES)
    return DataPacket(blocks, azimuths, dual, counter_us, calendar(date))


def calendar(date: Sequence[int]) -> datetime | None:
    """Year after 2000, month, day, hour, minute, second; None if there is no such moment."""
    year, month, day, hour, minute, second = date
    try:
        return datetime(2000 + year, month, day, hour, minute, second, tzinfo=UTC)
    except ValueError:
        return None


def _turns_evenly(packet: DataPacket) -> bool:
    """Clockwise, neither standing nor faster than any head; two echoes of a ray lie in one direction."""
    if max(packet.azimuths) >= TURN_CDEG:
        return False
    if packet.dual and packet.azimuths[::2] != packet.azimuths[1::2]:
        return False
    return max(packet.steps) <= MOST_STEP_CDEG and any(packet.steps)
