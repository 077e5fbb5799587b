"""Scans of a real LiDAR reach the row worker: an RPLIDAR behind TCP, byte for byte, without its pictures."""

from __future__ import annotations

import socket
import threading
import time

import numpy as np

from navcore.drivers.rplidar.lidar_params import LidarParams
from navcore.drivers.rplidar.protocol import Answer
from navcore.messages import LidarScan
from navcore.runtime.scans import RealScans
from navcore.sim.rplidar_device import RplidarDevice
from tests.navcore.drivers.rplidar_scenes import room
from tests.navcore.drivers.test_rplidar_reader import over_tcp, wait_for


def test_turns_of_an_rplidar_become_scans_with_its_ranges() -> None:
    device, scans = RplidarDevice(room, Answer.EXPRESS), list[LidarScan]()
    with socket.create_server(("127.0.0.1", 0)) as server:
        host, port = server.getsockname()
        player = threading.Thread(target=over_tcp, args=(server, device, 1500), daemon=True)
        player.start()
        source = RealScans(LidarParams(address=f"tcp://{host}:{port}"))

        def taken() -> bool:
            scans.extend(source.take())
            return len(scans) >= 3

        wait_for(taken)
        source.close()
        player.join()
    last = scans[-1]
    assert last.began_ns < last.stamp_ns <= time.monotonic_ns()
    angles, distances = np.array(last.angles), np.array(last.distances)
    assert len(angles) == len(distances) > 500
    assert np.percentile(np.abs(distances - room(-np.degrees(angles))), 90) < 0.03  # m
