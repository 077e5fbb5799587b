"""What a LiDAR tells of itself beside its data: a C16's device packet (DIFOP), and a VLP-16's position packet."""

from __future__ import annotations

import struct
from dataclasses import dataclass, replace
from datetime import datetime

from navcore.drivers.lidar3d.data_packet import calendar
from navcore.drivers.lidar3d.models import C16, C16_FINE, CHANNELS, LidarModel

DEVICE_HEAD = b"\xa5\xff\x00\x5a"
DEVICE_BYTES = 1206
POSITION_BYTES = 512
_RPM_AT, _VERSION_AT = 8, 1202
# Where angles and clock stand: in the second version of the packet, and in every other.
_ANGLES_AT, _OLD_ANGLES_AT, _CLOCK_AT, _OLD_CLOCK_AT = 234, 245, 36, 52
# Leishen's own drivers believe no angle that lies further from the nominal one.
MOST_OFF_DEG = 1.5
_POSITION_AT, _SENTENCE_AT = 198, 206
_PPS = ("no pulse per second", "synchronizing to the pulse per second", "locked to the pulse per second", "PPS error")


@dataclass(frozen=True, slots=True)
class DeviceInfo:
    """Attributes:
    rpm: set speed of the head. vertical_deg: measured at the maker's. utc: its clock, None if it shows no moment.
    """

    rpm: int
    vertical_deg: tuple[float, ...]
    utc: datetime | None

    @property
    def model(self) -> LidarModel | None:
        """The C16 that has such beams; None where the angles are of neither, as of a device that tells none."""
        return next((model for model in (C16, C16_FINE) if self.fits(model)), None)

    def fits(self, model: LidarModel) -> bool:
        """Whether the beams are those of the model."""
        pairs = zip(self.vertical_deg, model.vertical_deg, strict=True)
        return all(abs(told - nominal) <= MOST_OFF_DEG for told, nominal in pairs)

    def calibrated(self, model: LidarModel) -> LidarModel:
        """The model with these beams."""
        return replace(model, vertical_deg=self.vertical_deg)


@dataclass(frozen=True, slots=True)
class PositionInfo:
    """Attributes:
    counter_us: the device's clock past the hour. pps: its state in words. sentence: the newest NMEA, or empty.
    """

    counter_us: int
    pps: str
    sentence: str


def device_info(data: bytes) -> DeviceInfo | None:
    """From a C16's device packet; None if it is none."""
    if len(data) != DEVICE_BYTES or not data.startswith(DEVICE_HEAD):
        return None
    new = data[_VERSION_AT] == 2
    angles = struct.unpack_from(f">{CHANNELS}h", data, _ANGLES_AT if new else _OLD_ANGLES_AT)
    clock_at = _CLOCK_AT if new else _OLD_CLOCK_AT
    (rpm,) = struct.unpack_from(">H", data, _RPM_AT)
    return DeviceInfo(rpm, tuple(angle / 100.0 for angle in angles), calendar(data[clock_at : clock_at + 6]))


def position_info(data: bytes) -> PositionInfo | None:
    """From a VLP-16's position packet; None if it is none."""
    if len(data) != POSITION_BYTES or any(data[:_POSITION_AT]) or data[_POSITION_AT + 4] >= len(_PPS):
        return None
    counter_us, pps = struct.unpack_from("<IB", data, _POSITION_AT)
    sentence = data[_SENTENCE_AT:].partition(b"\r\n")[0].rstrip(b"\0").decode("ascii", errors="replace")
    return PositionInfo(counter_us, _PPS[pps], sentence if sentence.startswith("$") else "")
