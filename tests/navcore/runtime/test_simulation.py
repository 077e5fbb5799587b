"""What an operator chooses of the simulated world reaches it."""

from __future__ import annotations

import msgspec

from navcore.messages import LidarScan
from navcore.runtime.simulation import SimulationParams
from navcore.sim.demo_farm import demo_farm
from navcore.topics import LIDAR_SCAN
from navcore.transport.codec import decode, encode
from navcore.vehicle import PAPER_B


def test_a_robot_with_a_lidar_hands_out_turns_that_fit_their_topic() -> None:
    told = msgspec.json.encode(SimulationParams(lidar2d=True))
    params = msgspec.json.decode(told, type=SimulationParams)
    world = params.world(demo_farm(), PAPER_B, 0)
    scans = [s for k in range(1, 26) for s in world.advance(k * 10_000_000, 0.0, 0.0).scans]
    assert len(scans) == 2
    assert LIDAR_SCAN.type is LidarScan
    assert decode(LidarScan, encode(scans[0])) == scans[0]


def test_without_one_there_are_none() -> None:
    world = SimulationParams().world(demo_farm(), PAPER_B, 0)
    assert world.advance(250_000_000, 0.0, 0.0).scans == ()
