"""The simulated robot's body and surroundings as a process: `python -m navcore.runtime.world_process --help`.

It speaks as the real ones do: frames on the CAN bus, NMEA text over TCP. Its truth goes on the bus for the simulated
camera, the 3D view and the score, never into the navigator.
"""

from __future__ import annotations

import argparse
import contextlib
import select
import signal
import socket
import time
from pathlib import Path

import can
import msgspec

from navcore.chassis.scout_can import Frame
from navcore.maps.site_map import SiteMap
from navcore.promptness import be_prompt, no_pauses
from navcore.runtime.clock import Every
from navcore.runtime.simulation import SimulationParams
from navcore.runtime.site_file import read_site
from navcore.sim.scout_ecu import ScoutEcu, ScoutEcuParams
from navcore.sim.world import WorldOutput
from navcore.topics import IMU_SAMPLE, LIDAR_SCAN, SIM_CONTACT, SIM_FARM, SIM_TRUTH
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher
from navcore.vehicle import PROFILES, VehicleParams

STEP_NS = 5_000_000
TRUTH_NS = 20_000_000
PRIORITY = 10  # a world that stutters is no fair test of who drives in it
FARM_NS = 1_000_000_000


class ReceiverSocket:
    """The simulated receiver's output: whoever connects gets the text."""

    def __init__(self, port: int) -> None:
        self._listener = socket.create_server(("127.0.0.1", port))
        self._listener.setblocking(False)
        self._clients: list[socket.socket] = []

    def send(self, text: bytes) -> None:
        """To every client; one that does not read is dropped."""
        with contextlib.suppress(OSError):
            client, _ = self._listener.accept()
            client.setblocking(False)
            self._clients.append(client)
        if text:
            self._clients = [client for client in self._clients if self._hand_over(client, text)]

    def _hand_over(self, client: socket.socket, text: bytes) -> bool:
        try:
            return client.send(text) == len(text)
        except OSError:
            client.close()
            return False

    def close(self) -> None:
        """Hang up."""
        for client in self._clients:
            client.close()
        self._listener.close()


class WorldProcess:
    """World, chassis and receiver around one clock."""

    def __init__(
        self, endpoints: Endpoints, site: SiteMap, vehicle: VehicleParams, params: SimulationParams, bus: can.BusABC,
        gnss_port: int,
    ) -> None:  # fmt: skip
        self._now_ns = time.monotonic_ns()
        self._world = params.world(site, vehicle, self._now_ns)
        self._ecu = ScoutEcu(ScoutEcuParams(wheel_diameter=vehicle.wheel_diameter))
        self._bus = bus
        self._receiver = ReceiverSocket(gnss_port)
        self._publisher = Publisher(endpoints, "world")
        self._truth, self._farm = Every(TRUTH_NS), Every(FARM_NS)

    def step(self) -> None:
        """Wait for frames until the next step is due, then move the world."""
        self._listen(self._now_ns + STEP_NS)
        now_ns = time.monotonic_ns()
        self._now_ns += max(STEP_NS, (now_ns - self._now_ns) // STEP_NS * STEP_NS)
        v, omega = self._ecu.target(self._now_ns)
        output = self._world.advance(self._now_ns, v, omega)
        for frame in self._ecu.feedback(self._now_ns, output.wheels):
            self._send(frame)
        self._receiver.send(output.nmea)
        self._tell(output)

    def _tell(self, output: WorldOutput) -> None:
        for sample in output.imu:
            self._publisher.publish(IMU_SAMPLE.name, sample)
        for scan in output.scans:
            self._publisher.publish(LIDAR_SCAN.name, scan)
        for contact in output.contacts:
            self._publisher.publish(SIM_CONTACT.name, contact)
        if self._truth.due(self._now_ns):
            self._publisher.publish(SIM_TRUTH.name, output.truth)
        if self._farm.due(self._now_ns):
            self._publisher.publish(SIM_FARM.name, self._world.farm())

    def _listen(self, until_ns: int) -> None:
        while True:
            left_ns = until_ns - time.monotonic_ns()
            ready, _, _ = select.select([self._bus], [], [], max(0, left_ns) * 1e-9)
            if not ready:
                return
            message = self._bus.recv(0.0)
            if message is not None:
                self._ecu.receive(Frame(message.arbitration_id, bytes(message.data)), time.monotonic_ns())
            if left_ns <= 0:
                return

    def _send(self, frame: Frame) -> None:
        with contextlib.suppress(can.CanError):
            self._bus.send(can.Message(arbitration_id=frame.can_id, data=frame.data, is_extended_id=False))

    def close(self) -> None:
        """The world ends."""
        self._receiver.close()
        self._publisher.close()
        self._bus.shutdown()


def main() -> None:
    """Run until SIGTERM."""
    parser = argparse.ArgumentParser(prog="world", description="Simulates the robot's body and its orchard.")
    parser.add_argument("--bus", type=Path, required=True, help="directory of the station's sockets")
    parser.add_argument("--site", type=Path, required=True, help="site map as JSON")
    parser.add_argument("--vehicle", default="paper_a", choices=sorted(PROFILES))
    parser.add_argument("--gnss-port", type=int, required=True)
    parser.add_argument("--channel", required=True, help="multicast group of the CAN bus")
    parser.add_argument("--can-port", type=int, required=True)
    parser.add_argument("--simulation", default="{}", help="SimulationParams as JSON")
    given = parser.parse_args()
    params = msgspec.json.decode(given.simulation, type=SimulationParams)
    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    bus = can.Bus(interface="udp_multicast", channel=given.channel, port=given.can_port, hop_limit=0, fd=False)
    endpoints, site = Endpoints(given.bus), read_site(given.site)
    process = WorldProcess(endpoints, site, PROFILES[given.vehicle], params, bus, given.gnss_port)
    no_pauses()
    be_prompt(PRIORITY)
    while not ended:
        process.step()
    process.close()


if __name__ == "__main__":
    main()
