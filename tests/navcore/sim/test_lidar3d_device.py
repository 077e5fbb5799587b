"""The emulated 3D LiDARs: points find their beams again, and the same world gives the same bytes."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from navcore.drivers.lidar3d.models import CHANNELS, MODELS, LidarModel, ModelName
from navcore.drivers.lidar3d.rays import Rays, ends
from navcore.drivers.lidar3d.stream import LidarStream
from navcore.geometry.point_cloud import PointCloud
from navcore.sim.lidar3d_beams import polar
from navcore.sim.lidar3d_device import Lidar3dDevice, Lidar3dDeviceParams
from navcore.sim.lidar3d_sweep import firing_step_deg, sweep
from tests.navcore.drivers.lidar3d_scenes import arrivals, fed, room_cloud


@settings(deadline=None)
@given(name=st.sampled_from(ModelName), seed=st.integers(0, 2**32 - 1))
def test_direction_and_distance_are_found_again_from_where_a_ray_ends(name: ModelName, seed: int) -> None:
    model, rng, n = MODELS[name], np.random.default_rng(seed), 50
    channel = rng.integers(0, CHANNELS, n)
    turned, distance = rng.uniform(0.0, 360.0, n), rng.uniform(0.3, 100.0, n)
    rays = Rays(turned, np.zeros(n), distance, np.zeros(n, dtype=np.uint8), channel)
    cloud = PointCloud(
        points=ends(rays, model), times=np.zeros(n), intensities=rays.intensity, rings=model.rings()[channel]
    )
    azimuth, found = polar(cloud, model)
    assert np.abs(np.mod(azimuth - turned + 180.0, 360.0) - 180.0).max() < 1e-9  # deg
    assert found == pytest.approx(distance, abs=1e-9)  # m


@pytest.mark.parametrize("model", MODELS.values(), ids=lambda model: str(model.name))
def test_a_sweep_is_one_turn_of_all_channels(model: LidarModel) -> None:
    rays = sweep(model, 600.0)
    assert np.all(np.diff(rays.us) > 0.0)
    assert rays.turned_deg[0] == 0.0
    assert 360.0 - rays.turned_deg[-1] < firing_step_deg(model, 600.0)
    assert np.bincount(rays.channel).min() > 1800


@pytest.mark.parametrize("rpm", [300.0, 1200.0])
def test_a_head_may_turn_slower_and_faster(rpm: float) -> None:
    model = MODELS[ModelName.C16]
    device = Lidar3dDevice(lambda _: room_cloud(ModelName.C16), Lidar3dDeviceParams(rpm=rpm))
    stream = LidarStream(model)
    turns = fed(stream, arrivals(model, tuple(device.run(2.6 * 60.0 / rpm))))
    assert [turn.period_s for turn in turns] == pytest.approx([60.0 / rpm], abs=1e-4)  # s
    assert not stream.refused


def test_the_same_world_gives_the_same_bytes() -> None:
    first, second = (Lidar3dDevice(lambda _: room_cloud(ModelName.C16)).run(0.02) for _ in range(2))
    assert first == second
    portions = Lidar3dDevice(lambda _: room_cloud(ModelName.C16))
    assert [data for _ in range(20) for data in portions.run(0.001)] == first
