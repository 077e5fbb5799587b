"""`python -m navcore.sim.camera_warm_up`: compile the renderer's inner loops, so that no drive waits for them."""

from __future__ import annotations

from navcore.geometry.pinhole import robot_camera
from navcore.maps.site_map import Datum, Row, SiteMap
from navcore.messages import SimTruth
from navcore.sim.camera_labels import LabelParams
from navcore.sim.camera_light import LightName, named_light
from navcore.sim.camera_renderer import CameraRenderer, RenderParams
from navcore.sim.orchard import OrchardParams
from navcore.sim.planting import build_orchard


def warm_up() -> None:
    """Render one small frame; the machine code stays in numba's cache on disk."""
    row = Row(id="row", start=(0.0, 0.0), end=(8.0, 0.0))
    site = SiteMap(name="warm-up", datum=Datum(lat_deg=0.0, lon_deg=0.0, height_m=0.0), rows=(row,))
    renderer = CameraRenderer(
        build_orchard(site, OrchardParams()), robot_camera(width_px=64, height_px=36), named_light(LightName.NOON),
        RenderParams(labels=LabelParams()),
    )  # fmt: skip
    renderer.render(SimTruth(stamp_ns=0, x=0.0, y=0.0, yaw=0.0, roll=0.0, pitch=0.0, v=0.0, omega=0.0), 0)


if __name__ == "__main__":
    warm_up()
