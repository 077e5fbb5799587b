"""Where the processes of one station meet: socket files in one private directory."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from navcore.errors import TransportError

LONGEST_SOCKET_PATH = 107  # bytes of sun_path less its end mark, man 7 unix
SOCKET_MODE = 0o600


@dataclass(frozen=True, slots=True)
class Endpoints:
    """All addresses of one station. Two stations on one machine have two directories.

    Attributes:
        directory: holds every socket; readable by its owner alone.
    """

    directory: Path

    def prepare(self) -> None:
        """Make the directory, mode 0700. Raises TransportError if its path is too long for a socket."""
        longest = self.directory / "navigator_requests.sock"
        if len(bytes(longest.absolute())) > LONGEST_SOCKET_PATH - 16:
            raise TransportError(f"The path {self.directory} is too long for sockets. Choose a shorter directory.")
        self.directory.mkdir(parents=True, exist_ok=True, mode=0o700)
        self.directory.chmod(0o700)

    def socket(self, name: str) -> Path:
        """Path of a socket."""
        return self.directory.absolute() / f"{name}.sock"

    def publisher(self, process: str) -> Path:
        """Where a process publishes its topics."""
        return self.socket(f"pub_{process}")

    @property
    def navigator_requests(self) -> Path:
        """`Request` in, `Reply` out."""
        return self.socket("navigator_requests")

    @property
    def recorder_requests(self) -> Path:
        """`RecorderRequest` in, `RecorderReply` out."""
        return self.socket("recorder_requests")

    @property
    def supervisor_requests(self) -> Path:
        """`SupervisorRequest` in, `SupervisorReply` out."""
        return self.socket("supervisor_requests")

    @property
    def calibrator_requests(self) -> Path:
        """`CalibratorRequest` in, `CalibratorReply` out."""
        return self.socket("calibrator_requests")

    @property
    def guard_command(self) -> Path:
        """Datagrams to the guard: motion commands and arm requests, from the navigator alone."""
        return self.socket("guard_command")

    @property
    def guard_stop(self) -> Path:
        """Datagrams to the guard: STOP and nothing else, free for all."""
        return self.socket("guard_stop")

    @property
    def chassis_state(self) -> Path:
        """Datagrams from the guard to the navigator: `ChassisState`."""
        return self.socket("chassis_state")


def zmq_address(path: Path) -> str:
    """ZeroMQ's name of a socket file."""
    return f"ipc://{path}"
