"""A thread that keeps an RPLIDAR connected and turning, and hands out its turns."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from navcore.drivers.byte_source import ByteSource
from navcore.drivers.kept_connection import KeptConnection
from navcore.drivers.rplidar.protocol import Command, express_scan, motor_speed, request
from navcore.drivers.rplidar.revolutions import Revolution, Revolutions
from navcore.drivers.rplidar.stream import RplidarStream

BAD_HEALTH = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class RplidarParams:
    """Parameters of `RplidarReader`.

    Attributes:
        scan: the request for rays; `request(Command.SCAN)` for devices without express answers.
        rpm: of the motor; devices that turn by themselves pass it over.
        answer_s: a device that has not answered for so long is none, or listens at another speed, s.
        silent_s: one that streams and has sent nothing for so long has hung up, s.
        reconnect_s: between two attempts, s.
    """

    scan: bytes = express_scan()
    rpm: int = 600
    answer_s: float = 1.0
    silent_s: float = 1.0
    reconnect_s: float = 1.0


class RplidarReader(KeptConnection):
    """Reads until stopped; a connection that is lost or silent is opened again.

    Args:
        open_source: opens the connection; OSError while there is none.
        deliver: called in the reader's thread with each turn.
        clock: monotonic time in ns.
    """

    def __init__(
        self, open_source: Callable[[], ByteSource], deliver: Callable[[Revolution], None], clock: Callable[[], int],
        params: RplidarParams = RplidarParams(),
    ) -> None:  # fmt: skip
        self._deliver, self._clock, self._params = deliver, clock, params
        super().__init__("rplidar-reader", open_source, self._scan, params.reconnect_s)

    def _scan(self, source: ByteSource) -> None:
        """Until the reader is stopped; then the sensor is as well."""
        self._ask_health(source)
        source.write(motor_speed(self._params.rpm))
        source.write(self._params.scan)
        self._read_turns(source)
        source.write(request(Command.STOP))

    def _ask_health(self, source: ByteSource) -> None:
        """What still streams from an earlier connection is passed over until the answer comes."""
        source.write(request(Command.STOP))
        source.write(request(Command.GET_HEALTH))
        stream, late_ns = RplidarStream(), self._clock() + int(self._params.answer_s * 1e9)
        while stream.health is None:
            if self._clock() > late_ns or not self.going:
                heard = (
                    "only noise: is the speed of its port right?" if stream.refused else "nothing: is it switched on?"
                )
                raise OSError(f"no RPLIDAR answers; heard {heard}")
            stream.feed(source.read())
        if stream.health.status >= BAD_HEALTH:
            raise OSError(stream.health.words)
        self.problem = stream.health.words if stream.health.status else ""

    def _read_turns(self, source: ByteSource) -> None:
        stream, turns, heard_ns = RplidarStream(), Revolutions(), self._clock()
        while self.going:
            data, now_ns = source.read(), self._clock()
            for rays in stream.feed(data):
                heard_ns = now_ns
                for turn in turns.add(rays, now_ns):
                    self._deliver(turn)
            if now_ns - heard_ns > self._params.silent_s * 1e9:
                raise OSError("the LiDAR sends no rays; it is asked to begin anew")
