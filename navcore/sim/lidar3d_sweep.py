"""Where the rays of a spinning LiDAR point, and what a scene makes of one turn of them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from navcore.drivers.lidar3d.models import CHANNELS, LidarModel
from navcore.drivers.lidar3d.rays import Rays, ends
from navcore.geometry.point_cloud import PointCloud

Floats = NDArray[np.float64]
# Distances, m, that rays meet: origins and directions (N, 3) in `lidar3d`, s since the turn began (N,); 0 for none.
Scene3d = Callable[[Floats, Floats, Floats], Floats]
_INTENSITY = 100


def firing_step_deg(model: LidarModel, rpm: float) -> float:
    """How far the head turns between two firings of all channels."""
    return rpm * 6.0 * model.firing_us * 1e-6


def sweep(model: LidarModel, rpm: float = 600.0) -> Rays:
    """Rays of the turn that begins with the first firing, of no length yet."""
    firings = int(np.ceil(360.0 / firing_step_deg(model, rpm)))
    us = np.arange(firings)[:, None] * model.firing_us + np.arange(CHANNELS) * model.channel_us
    turned = us * (rpm * 6e-6)
    channel = np.broadcast_to(np.arange(CHANNELS), us.shape)
    inside = turned < 360.0
    n = int(np.count_nonzero(inside))
    return Rays(turned[inside], us[inside], np.zeros(n), np.full(n, _INTENSITY, dtype=np.uint8), channel[inside])


def swept_cloud(scene: Scene3d, model: LidarModel, rpm: float = 600.0) -> PointCloud:
    """What the sensor measures of a scene in one turn."""
    rays = sweep(model, rpm)
    origins = ends(rays, model)
    directions = ends(rays._replace(distance=np.ones(len(rays.us))), model) - origins
    met = rays._replace(distance=scene(origins, directions, rays.us * 1e-6))
    met = met.where(met.distance > 0.0)
    return PointCloud(
        points=ends(met, model), times=(met.us - rays.us[-1]) * 1e-6, intensities=met.intensity,
        rings=model.rings()[met.channel],
    )  # fmt: skip
