"""Turns of the one 3D LiDAR in a recorded capture."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from pathlib import Path

from navcore.drivers.lidar3d.capture_file import CaptureFile, Datagram
from navcore.drivers.lidar3d.data_packet import is_data
from navcore.drivers.lidar3d.models import MODELS, LidarModel
from navcore.drivers.lidar3d.stream import LidarStream
from navcore.drivers.lidar3d.turns import Turn
from navcore.errors import LogError

# A device packet comes every second.
LOOKED_THROUGH = 20_000


class CaptureTurns:
    """Reads a capture turn by turn, so that memory does not grow with it.

    Attributes:
        file: what else it holds. stream: what came of the LiDAR's packets; the turns' stamps count from 1970.
        sender: address of the LiDAR.

    Args:
        model: of the LiDAR; None where its packets tell it.
        sender: its address; empty where the capture holds but one.
        incomplete: tell also the turns at its beginning and end.

    Raises:
        LogError: if the file cannot be read, is no capture, holds no LiDAR's packets or those of several, does not
            tell the model, or tells another one than is named.
    """

    def __init__(
        self, path: Path, model: LidarModel | None = None, sender: str = "", *, incomplete: bool = False
    ) -> None:
        self._path = path
        self.file = CaptureFile(path)
        self.sender = self._one_sender(sender)
        self.stream = LidarStream(model or self._told_model(), incomplete=incomplete)

    def turns(self) -> Iterator[Turn]:
        """All of them, once. Raises LogError where none of the packets is of the model."""
        for datagram in self._datagrams():
            turn = self.stream.feed(datagram.data, datagram.arrived_ns)
            if turn is not None:
                yield turn
        if (last := self.stream.flush()) is not None:
            yield last
        if self.stream.contradiction and not self.stream.packets:
            raise LogError(f"{self._path}: {self.stream.contradiction}")

    def _datagrams(self) -> Iterator[Datagram]:
        return (datagram for datagram in self.file.datagrams() if datagram.sender == self.sender)

    def _one_sender(self, wanted: str) -> str:
        senders = Counter(datagram.sender for datagram in self.file.datagrams() if is_data(datagram.data))
        if not senders:
            raise LogError(
                f"{self._path} holds no packets of a LiDAR that is known here (VLP-16, C16); capture the UDP port "
                "that it sends its data to, usually 2368."
            )
        if wanted and wanted not in senders:
            raise LogError(f"{self._path} holds no LiDAR at {wanted}; those in it are at {', '.join(senders)}.")
        if not wanted and len(senders) > 1:
            raise LogError(f"{self._path} holds LiDARs at {', '.join(senders)}; name the one that is meant.")
        return wanted or next(iter(senders))

    def _told_model(self) -> LidarModel:
        """As the packets tell it."""
        stream = LidarStream(None)
        for _, datagram in zip(range(LOOKED_THROUGH), self._datagrams(), strict=False):
            stream.feed(datagram.data, datagram.arrived_ns)
            if stream.model is not None:
                return MODELS[stream.model.name]
        raise LogError(f"{self._path}: {stream.contradiction} Known are {', '.join(MODELS)}.")
