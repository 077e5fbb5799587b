"""Datagrams of a 3D LiDAR to turns; what is no packet of it is passed over and counted, never guessed."""

from __future__ import annotations

from collections import Counter
from datetime import datetime

from navcore.drivers.lidar3d.data_packet import contradiction, is_data, open_packet, told_model
from navcore.drivers.lidar3d.device_packets import DeviceInfo, PositionInfo, device_info, position_info
from navcore.drivers.lidar3d.models import VLP16, LidarModel, ModelName
from navcore.drivers.lidar3d.refusals import Refused
from navcore.drivers.lidar3d.turns import Turn, Turns, TurnsParams


class LidarStream:
    """One device's datagrams, from whichever of its ports.

    Attributes:
        packets: of data, that were sound.
        device, position: the newest of each.
        utc: date and time that the newest sound packet told, None where they tell none.
        refused: packets and turns by reason.

    Args:
        model: None to learn it from the packets: a VLP-16's data say it, and a C16's device packets.
    """

    def __init__(self, model: LidarModel | None, params: TurnsParams = TurnsParams()) -> None:
        self._params = params
        self.refused: Counter[Refused] = Counter()
        self.packets = 0
        self.device: DeviceInfo | None = None
        self.position: PositionInfo | None = None
        self.utc: datetime | None = None
        self._turns = self._of(model) if model else None
        self._wrong_data = self._wrong_device = ""

    @property
    def model(self) -> LidarModel | None:
        """Of the LiDAR, as calibrated by it; None until something tells it."""
        return self._turns.model if self._turns else None

    @property
    def lost(self) -> int:
        """Packets that never came."""
        return self._turns.lost if self._turns else 0

    @property
    def contradiction(self) -> str:
        """A sentence while the packets are of another model than is set, else empty."""
        return self._wrong_device or self._wrong_data

    def feed(self, data: bytes, arrived_ns: int) -> Turn | None:
        """The turn that a datagram completes, if it does."""
        if not is_data(data) and self._tells_of_itself(data):
            return None
        turns = self._turns or self._learn(data)
        if turns is None:
            return None
        packet = Refused.OTHER_MODEL if self._wrong_device else open_packet(data, turns.model)
        if isinstance(packet, Refused):
            self._refuse(packet, data, turns.model)
            return None
        self.packets += 1
        self.utc, self._wrong_data = packet.utc, ""
        return turns.add(packet, arrived_ns)

    def _of(self, model: LidarModel) -> Turns:
        return Turns(model, self.refused, self._params)

    def _learn(self, data: bytes) -> Turns | None:
        told = told_model(data) if is_data(data) else ""
        if told and not contradiction(data, VLP16):
            self._turns = self._of(VLP16)
            self._wrong_data = ""
        elif is_data(data):
            self.refused[Refused.NO_MODEL] += 1
            self._wrong_data = _unknown(told)
        else:
            self.refused[Refused.FOREIGN] += 1
        return self._turns

    def _refuse(self, reason: Refused, data: bytes, model: LidarModel) -> None:
        self.refused[reason] += 1
        if reason is Refused.OTHER_MODEL:
            self._wrong_data = contradiction(data, model)

    def _tells_of_itself(self, data: bytes) -> bool:
        """Take in a device or position packet."""
        if (device := device_info(data)) is not None:
            self._take_device(device)
            return True
        if (position := position_info(data)) is not None:
            self.position = position
            return True
        return False

    def _take_device(self, device: DeviceInfo) -> None:
        """Measured angles take the nominal ones' place; those of the other C16 contradict the settings."""
        self.device, told = device, device.model
        if told is None:
            return
        if self._turns is None:
            self._turns, self._wrong_data = self._of(device.calibrated(told)), ""
        elif told.name is self._turns.model.name:
            self._turns.model, self._wrong_device = device.calibrated(self._turns.model), ""
        elif self._turns.model.name is not ModelName.VLP16:
            self._wrong_device = (
                f"The LiDAR's own angles are those of a {told.title}, but it is set to be a "
                f"{self._turns.model.title}. Correct its model."
            )


def _unknown(told: str) -> str:
    if told:
        return f"The packets come from a Velodyne {told}, which is not known here; a VLP-16 and a C16 are."
    return "The packets do not say which LiDAR sent them. Name its model."
