"""The whole station as it is shipped, `rowpilot run`, driven over its own HTTP interface."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
import tempfile
import time
from http.cookiejar import CookieJar
from pathlib import Path
from typing import Any, Self
from urllib.error import HTTPError
from urllib.request import HTTPCookieProcessor, Request, build_opener

import msgspec

from navcore.errors import TransportError
from navcore.maps.ndt.ndt_file import write_ndt_map
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.runtime.map_file import map_beside
from navcore.runtime.simulation import SimulationParams
from navcore.transport.endpoints import Endpoints
from navcore.transport.request import Requester
from navcore.transport.supervision import SupervisorReply, SupervisorRequest, SupervisorRequestKind

ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/enter\?token=\S+")
START_S, END_S, ANSWER_S = 180.0, 60.0, 30.0
POLL_S = 0.2


class LoopStation:
    """A running station and a login to it. Raises TransportError where it does not start or refuses."""

    def __init__(self, folder: Path, simulation: SimulationParams = SimulationParams()) -> None:
        self.folder, self.simulation = folder, simulation
        self._bus = Path(tempfile.mkdtemp(prefix="rp-"))  # short: the names of sockets must be
        self.endpoints = Endpoints(self._bus)
        self.cookies = CookieJar()
        self._opener = build_opener(HTTPCookieProcessor(self.cookies))
        self._process = self._start()
        address = self._address()
        self.origin = address.partition("/enter")[0]
        self._enter(address)

    def get(self, path: str) -> Any:
        """The station's answer."""
        return self._send(Request(self.origin + path))

    def post(self, path: str, body: Any = None, raw: bytes | None = None) -> Any:
        """Ask as a page does, with `body` as JSON or `raw` as it is."""
        data = raw if raw is not None else json.dumps(body or {}).encode()
        kind = "application/octet-stream" if raw is not None else "application/json"
        headers = {"Origin": self.origin, "X-Rowpilot": "1", "Content-Type": kind}
        return self._send(Request(self.origin + path, data=data, headers=headers, method="POST"))

    def processes(self) -> dict[str, int]:
        """Process ids by name, of those that run."""
        requester = Requester(self.endpoints.supervisor_requests, "supervisor")
        try:
            status = SupervisorRequest(kind=SupervisorRequestKind.STATUS)
            reply = requester.ask(status, SupervisorReply, timeout_ms=5000)
        finally:
            requester.close()
        return {process.name: process.pid for process in reply.processes if process.pid is not None}

    def can_bus(self) -> tuple[str, int]:
        """Multicast group and port of the simulated chassis' bus, from the guard's own arguments."""
        arguments = Path(f"/proc/{self.processes()['guard']}/cmdline").read_bytes().decode().split("\0")
        port = next(a for a in arguments if a.startswith("port="))
        return arguments[arguments.index("--channel") + 1], int(port.removeprefix("port="))

    def use_map(self, site_id: str, ndt_map: NdtMap) -> None:
        """Lay it beside the robot's farm: the scan worker looks there every two seconds."""
        write_ndt_map(map_beside(self.folder / "robot" / f"{site_id}.json"), ndt_map)

    def logs(self) -> list[Path]:
        """Run logs, oldest first."""
        return sorted((self.folder / "runs").glob("*.mcap"), key=lambda log: log.stat().st_mtime_ns)

    def close(self) -> None:
        """End it in order, and by force where that does not help."""
        self._process.terminate()
        try:
            self._process.wait(END_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()

    def _start(self) -> subprocess.Popen[bytes]:
        self.folder.mkdir(parents=True, exist_ok=True)
        call = "from navcore.cli import main; main()"
        command = (sys.executable, "-c", call, "run", "--port", "0", "--data", str(self.folder),
                   "--simulation", msgspec.json.encode(self.simulation).decode())  # fmt: skip
        environment = {**os.environ, "ROWPILOT_BUS_DIR": str(self._bus)}
        with (self.folder / "out.txt").open("wb") as out, (self.folder / "err.txt").open("wb") as err:
            return subprocess.Popen(command, stdout=out, stderr=err, env=environment)

    def _address(self) -> str:
        deadline = time.monotonic() + START_S
        while time.monotonic() < deadline and self._process.poll() is None:
            if found := ADDRESS.search((self.folder / "out.txt").read_text()):
                return found[0]
            time.sleep(POLL_S)
        self.close()
        raise TransportError(f"The station did not start. See {self.folder / 'err.txt'}.")

    def _enter(self, address: str) -> None:
        try:
            self._opener.open(address, timeout=ANSWER_S).close()
        except HTTPError as error:
            self.close()
            words = error.read().decode(errors="replace")
            raise TransportError(f"The station lets nobody in ({error.code}): {words[:200]}") from error

    def _send(self, request: Request) -> Any:
        try:
            with self._opener.open(request, timeout=ANSWER_S) as response:
                body = response.read()
        except HTTPError as error:
            text = error.read().decode(errors="replace")
            raise TransportError(f"The station refused {request.selector}: {text[:500]}") from error
        return json.loads(body) if body else None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
