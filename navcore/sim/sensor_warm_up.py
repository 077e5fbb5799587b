"""`python -m navcore.sim.sensor_warm_up`: compile the inner loops of simulated sensors; no drive waits for them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from navcore.geometry.lidar_mount import robot_lidar
from navcore.geometry.pinhole import robot_camera
from navcore.maps.site_map import Datum, Row, SiteMap
from navcore.messages import SimTruth
from navcore.sim.camera_labels import LabelParams
from navcore.sim.camera_light import LightName, named_light
from navcore.sim.camera_renderer import CameraRenderer, RenderParams
from navcore.sim.canopy import Canopy, CanopyParams
from navcore.sim.lidar2d import Lidar2d, Lidar2dParams
from navcore.sim.orchard import OrchardParams
from navcore.sim.planting import build_orchard

TURN_NS = 100_000_000


def warm_up() -> None:
    """One small frame, one turn, and one look at the sky; the machine code stays in numba's cache on disk."""
    row = Row(id="row", start=(0.0, 0.0), end=(8.0, 0.0))
    site = SiteMap(name="warm-up", datum=Datum(lat_deg=0.0, lon_deg=0.0, height_m=0.0), rows=(row,))
    orchard = build_orchard(site, OrchardParams())
    camera, params = robot_camera(width_px=64, height_px=36), RenderParams(labels=LabelParams())
    renderer = CameraRenderer(orchard, camera, named_light(LightName.NOON), params)
    began = SimTruth(stamp_ns=0, x=0.0, y=0.0, yaw=0.0, roll=0.0, pitch=0.0, v=0.0, omega=0.0)
    renderer.render(began, 0)
    lidar = Lidar2d(orchard, robot_lidar(), Lidar2dParams(), np.random.default_rng(0))
    for turns in range(3):
        lidar.update(replace(began, stamp_ns=turns * TURN_NS))
    Canopy(orchard, CanopyParams(), seed=0).loss_db(0.0, 0.0, 1.0, np.array(((0.0, 0.6, 0.8),)))


if __name__ == "__main__":
    warm_up()
