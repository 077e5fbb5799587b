"""A thread that listens to a 3D LiDAR and hands out its turns."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

from navcore.drivers.byte_source import ByteSource
from navcore.drivers.kept_connection import KeptConnection
from navcore.drivers.lidar3d.lidar3d_params import Lidar3dParams
from navcore.drivers.lidar3d.refusals import Refused
from navcore.drivers.lidar3d.stream import LidarStream
from navcore.drivers.lidar3d.turns import Turn
from navcore.drivers.udp_source import UdpSource


class Lidar3dReader(KeptConnection):
    """Listens until stopped; a LiDAR that falls silent is listened to anew, and may be switched off and on.

    `stream` counts what came; only the reader's thread may feed it.

    Args:
        params: of the LiDAR. Raises ConfigError where they name none.
        deliver: called in the reader's thread with each turn.
        clock: monotonic time in ns.
    """

    def __init__(self, params: Lidar3dParams, deliver: Callable[[Turn], None], clock: Callable[[], int]) -> None:
        self._params, self._deliver, self._clock = params, deliver, clock
        self.stream = LidarStream(params.lidar_model(), params.turns)
        self._udp: UdpSource | None = None
        super().__init__("lidar3d-reader", self._open, self._listen, params.reconnect_s)

    def _open(self) -> UdpSource:
        self._udp = UdpSource(self._params.listen, self._params.ports(), self._params.sender)
        return self._udp

    def _listen(self, source: ByteSource) -> None:
        """Until the reader is stopped; OSError with the reason once no turns come."""
        turned_ns, packets, refused = self._clock(), self.stream.packets, self.stream.refused.copy()
        while self.going:
            data, now_ns = source.read(), self._clock()
            turn = self.stream.feed(data, now_ns) if data else None
            if turn is not None:
                self.problem, turned_ns, packets = "", now_ns, self.stream.packets
                self._deliver(turn)
            elif now_ns - turned_ns > self._params.silent_s * 1e9:
                raise OSError(self._why_none(self.stream.packets > packets, self.stream.refused - refused))

    def _why_none(self, sound: bool, refused: Counter[Refused]) -> str:
        """A sentence for the operator, by what came of late."""
        if self.stream.contradiction:
            return self.stream.contradiction
        if sound:
            return "the LiDAR sends packets, but no whole turn comes of them: too many are lost on their way"
        return self._why_no_packets(refused)

    def _why_no_packets(self, refused: Counter[Refused]) -> str:
        strangers = ", ".join(self._udp.strangers) if self._udp else ""
        if strangers:
            return f"packets come from {strangers}, but the LiDAR is set to be at {self._params.sender}"
        if refused[Refused.AZIMUTH]:
            return "the LiDAR's head does not turn"
        if refused[Refused.FOREIGN] or refused[Refused.SHORT]:
            return f"what comes on port {self._params.port} is not from a LiDAR that is known here"
        return (
            f"nothing comes from the LiDAR on port {self._params.port}: is it switched on, and set to send to this "
            "computer's address?"
        )
