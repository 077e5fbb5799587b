"""The simulated 3D LiDAR sees the world of the other process from where its truth says the robot is."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from navcore.geometry.lidar_mount import robot_lidar3d
from navcore.messages import SimTruth
from navcore.runtime.simulated_lidar3d import SimulatedLidar3d
from navcore.runtime.simulation import SimulationParams
from navcore.sim.body_pose import body_pose
from navcore.sim.demo_farm import demo_farm
from navcore.sim.lidar3d import SimTurn
from navcore.sim.rays.land_scene import Part
from navcore.sim.trellis.trellised import trellised
from navcore.topics import SIM_TRUTH
from navcore.transport.endpoints import Endpoints
from navcore.transport.pubsub import Publisher
from navcore.vehicle import SCOUT_2
from tests.navcore.sim.post_axes import away_from_posts

PARAMS = SimulationParams(world_seed=4, lidar3d=True)
TRIES = 400


def hear(publisher: Publisher, lidar: SimulatedLidar3d, place: tuple[float, float, float]) -> SimTurn:
    """Tell the truth of a robot that stands there until a turn comes."""
    x, y, yaw = place
    for k in range(TRIES):
        truth = SimTruth(stamp_ns=k * 20_000_000, x=x, y=y, yaw=yaw, roll=0.0, pitch=0.0, v=0.0, omega=0.0)
        publisher.publish(SIM_TRUTH.name, truth)
        if (turn := lidar.take(timeout_ms=20)) is not None:
            return turn
    pytest.fail(f"No turn came of {TRIES} truths.")


def test_its_turns_meet_the_posts_of_the_same_world(tmp_path: Path) -> None:
    endpoints, world = Endpoints(tmp_path), PARAMS.world(demo_farm(), SCOUT_2, 0)
    posts, row = trellised(world.site, world.orchard, world.terrain).posts, world.site.rows[2]
    yaw = float(np.arctan2(row.end[1] - row.start[1], row.end[0] - row.start[0]))
    place = ((row.start[0] + row.end[0]) / 2, (row.start[1] + row.end[1]) / 2, yaw)
    publisher = Publisher(endpoints, "world")
    lidar = SimulatedLidar3d(endpoints, demo_farm(), SCOUT_2, PARAMS, robot_lidar3d())
    turn = hear(publisher, lidar, place)
    lidar.close()
    publisher.close()
    truth = SimTruth(stamp_ns=0, x=place[0], y=place[1], yaw=yaw, roll=0.0, pitch=0.0, v=0.0, omega=0.0)
    seat = np.array((lidar.mount.x, lidar.mount.y, lidar.mount.z))
    points = body_pose(truth, world.terrain, SCOUT_2).apply(turn.cloud.points + seat)[turn.parts == int(Part.POST)]
    away = away_from_posts(points, posts)
    assert len(points) > 100
    assert np.abs(away - posts.radii[0]).max() < 0.12  # m: six sigma of the noise


def test_without_a_truth_there_is_no_turn(tmp_path: Path) -> None:
    lidar = SimulatedLidar3d(Endpoints(tmp_path), demo_farm(), SCOUT_2, PARAMS, robot_lidar3d())
    assert lidar.take() is None
    lidar.close()
