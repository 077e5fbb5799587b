"""The 3D LiDAR as a process: `python -m navcore.runtime.scan_worker --help`.

Clouds are read, or cast from the simulated world's truth, freed of the blur of the robot's motion and matched on the
farm's 3D map here, so that no cloud ever holds up the control loop: it hears of a place, some hundred bytes long.
"""

from __future__ import annotations

import argparse
import signal
import time
from dataclasses import replace
from pathlib import Path

import msgspec

from navcore.config import RobotConfig, load_config
from navcore.messages import Odometry
from navcore.messages.cloud import packed
from navcore.promptness import be_prompt
from navcore.runtime.clock import Every, Ticker
from navcore.runtime.cloud_matcher import MOTIONS, CloudMatcher
from navcore.runtime.clouds import Clouds, RealClouds, SimulatedClouds
from navcore.runtime.map_file import MapFile, map_beside
from navcore.runtime.simulated_lidar3d import SimulatedLidar3d
from navcore.runtime.simulation import SimulationParams
from navcore.runtime.site_file import read_site
from navcore.topics import LIDAR3D_CLOUD, MAP_MATCH, NAV_ODOMETRY
from navcore.transport.codec import decode
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher, Subscriber

TICK_NS = 10_000_000
LOOK_NS = 2_000_000_000
PRIORITY = 3  # before pages, after whoever ticks and whoever sees rows


class ScanWorker:
    """Takes clouds, tells them on, and says where each lies on the map."""

    def __init__(self, endpoints: Endpoints, clouds: Clouds, map_file: MapFile) -> None:
        self._clouds, self._map = clouds, map_file
        self._matcher = CloudMatcher(clouds.T_base_lidar)
        self._publisher = Publisher(endpoints, "scan_worker")
        self._bus = Subscriber(endpoints, (NAV_ODOMETRY.name,), queue_length=MOTIONS)
        self._look = Every(LOOK_NS)

    def work(self) -> None:
        """What has come since the last call."""
        if self._look.due(time.monotonic_ns()):
            self._map.look()
        while (received := self._bus.receive(0)) is not None:
            self._matcher.hear(decode(Odometry, received.payload))
        for turn in self._clouds.take():
            match = self._matcher.match(turn, self._map.localizer, self._map.reason)
            latency_ms = (time.monotonic_ns() - turn.stamp_ns) * 1e-6
            self._publisher.publish(MAP_MATCH.name, replace(match, latency_ms=latency_ms))
            self._publisher.publish(LIDAR3D_CLOUD.name, packed(turn.stamp_ns, turn.cloud))

    def close(self) -> None:
        """Let go of all."""
        self._clouds.close()
        self._publisher.close()
        self._bus.close()


def main() -> None:
    """Match until SIGTERM."""
    parser = argparse.ArgumentParser(prog="scan worker", description="Matches a 3D LiDAR's clouds on the farm's map.")
    parser.add_argument("--bus", type=Path, required=True, help="directory of the station's sockets")
    parser.add_argument("--site", type=Path, required=True, help="site map as JSON")
    parser.add_argument("--config", type=Path, help="settings of the robot, TOML")
    parser.add_argument("--simulation", help="SimulationParams as JSON; else the LiDAR of the settings")
    given = parser.parse_args()
    ended: list[int] = []
    signal.signal(signal.SIGTERM, lambda number, _: ended.append(number))
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    config = load_config(given.config) if given.config else RobotConfig()
    simulation = msgspec.json.decode(given.simulation, type=SimulationParams) if given.simulation else None
    endpoints = Endpoints(given.bus)
    clouds = _clouds(endpoints, given.site, simulation, config)
    worker = ScanWorker(endpoints, clouds, MapFile(map_beside(given.site), read_site(given.site).datum))
    be_prompt(PRIORITY)
    ticker = Ticker(TICK_NS)
    while not ended:
        ticker.wait()
        worker.work()
    worker.close()


def _clouds(endpoints: Endpoints, site: Path, params: SimulationParams | None, config: RobotConfig) -> Clouds:
    if params is None:
        return RealClouds(config.lidar3d)
    vehicle, mount = config.vehicle_params(), config.lidar3d.mount
    return SimulatedClouds(SimulatedLidar3d(endpoints, read_site(site), vehicle, params, mount))


if __name__ == "__main__":
    main()
