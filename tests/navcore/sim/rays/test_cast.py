"""A ray meets each shape where geometry says, and the walk through the grid misses nothing."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.typing import NDArray

from navcore.maps.site_map import Datum, Row, SiteMap, Warehouse
from navcore.sim.clutter import ClutterParams
from navcore.sim.orchard import OrchardParams, Trellis
from navcore.sim.planting import build_orchard
from navcore.sim.rays.cast import GROUND, NOTHING, cast, meet
from navcore.sim.rays.scene import RayScene, ray_scene
from navcore.sim.rays.shapes import meet_beam, meet_card, meet_panel, meet_tube

Floats = NDArray[np.float64]
DATUM = Datum(lat_deg=41.0, lon_deg=-5.0, height_m=700.0)
near = st.floats(-0.2, 0.2)


def shape(*numbers: float) -> Floats:
    row = np.zeros((1, 15))
    row[0, : len(numbers)] = numbers
    return row


def unit(x: float, y: float, z: float) -> tuple[float, float, float]:
    size = math.sqrt(x * x + y * y + z * z)
    return x / size, y / size, z / size


@settings(deadline=None)  # the first call compiles
@given(
    lean_x=near, lean_y=near, taper=st.floats(-0.04, 0.04), aside=st.floats(-0.05, 0.05), up=st.floats(-0.08, 0.08)
)
def test_a_leaning_tapering_tube_is_met_on_its_skin(
    lean_x: float, lean_y: float, taper: float, aside: float, up: float
) -> None:
    tube = shape(0.0, 0.0, 0.0, 0.10, lean_x, lean_y, 1.0, 0.10 + taper)
    d = unit(1.0, 0.0, up)
    t = meet_tube(tube, 0, -2.0, aside, 0.5, *d)
    x, y, z = -2.0 + t * d[0], aside + t * d[1], 0.5 + t * d[2]
    if not math.isfinite(t):
        assert abs(aside - 0.5 * lean_y) > 0.03 or not 0.0 < 0.5 + 2.0 * up < 1.0
        return
    assert math.hypot(x - z * lean_x, y - z * lean_y) == pytest.approx(0.10 + z * taper, abs=1e-9)
    assert x < z * lean_x + 0.05, "the near side is met, not the far one"


@settings(deadline=None)  # the first call compiles
@given(bx=st.floats(-0.5, 0.5), by=st.floats(0.5, 1.0), bz=st.floats(-0.5, 0.5), share=st.floats(0.1, 0.9))
def test_a_beam_is_met_one_radius_before_its_axis_by_a_ray_square_to_it(
    bx: float, by: float, bz: float, share: float
) -> None:
    axis = np.array((bx, by, bz))
    across = np.cross(axis, (0.3, 0.1, 1.0))
    d = across / np.linalg.norm(across)
    start = share * axis - 3.0 * d
    t = meet_beam(shape(0.0, 0.0, 0.0, bx, by, bz, 0.02, 0.02), 0, *start, *d)
    assert t == pytest.approx(2.98, abs=1e-9)


def test_a_beam_beside_the_ray_is_missed() -> None:
    beam = shape(0.0, -1.0, 0.5, 0.0, 1.0, 0.5, 0.01, 0.01)
    assert meet_beam(beam, 0, -2.0, 0.0, 0.52, 1.0, 0.0, 0.0) == math.inf
    assert meet_beam(beam, 0, -2.0, 1.1, 0.5, 1.0, 0.0, 0.0) == math.inf


def test_a_card_full_of_leaves_is_met_and_its_empty_corner_is_not() -> None:
    card = shape(0.0, 0.0, 0.5, 0.0, 0.2, 0.0, 0.0, 0.0, 0.2, 1.0, 0.0, 0.0, 25.0, 25.0, 1.0)
    assert meet_card(card, 0, -2.0, 0.03, 0.5, 1.0, 0.0, 0.0) == pytest.approx(2.0)
    assert meet_card(card, 0, -2.0, 0.19, 0.69, 1.0, 0.0, 0.0) == math.inf
    assert meet_card(card, 0, -2.0, 0.21, 0.5, 1.0, 0.0, 0.0) == math.inf


@pytest.mark.parametrize(
    ("y", "z", "met"), [(0.0, 1.0, True), (1.9, 1.9, True), (2.1, 1.0, False), (0.0, 2.1, False)]
)
def test_a_wall_is_met_within_its_corners_from_either_side(y: float, z: float, met: bool) -> None:
    wall = shape(0.0, -2.0, 0.0, 0.0, 2.0, 0.0, 0.0, 2.0, 2.0, 0.0, -2.0, 2.0, 1.0, 0.0, 0.0)
    for x, dx in ((-3.0, 1.0), (3.0, -1.0)):
        t = meet_panel(wall, 0, x, y, z, dx, 0.0, 0.0)
        assert t == (pytest.approx(3.0) if met else math.inf)


@pytest.fixture(scope="module")
def scene() -> RayScene:
    site = SiteMap(
        name="s", datum=DATUM, rows=(Row(id="r", start=(2.0, 1.0), end=(12.0, 3.0)),),
        warehouse=Warehouse(x=-6.0, y=-4.0, yaw=0.4),
    )  # fmt: skip
    clutter = ClutterParams(weeds_per_m=1.0, stake_share=0.5)
    return ray_scene(build_orchard(site, OrchardParams(trellis=Trellis.VSP, clutter=clutter)))


def test_the_walk_finds_what_looking_at_every_shape_finds(scene: RayScene) -> None:
    rng, hits = np.random.default_rng(3), 0
    for _ in range(40):
        x, y, z = rng.uniform((-3.0, -5.0, 0.1), (14.0, 8.0, 1.5)).tolist()
        dx, dy, dz = unit(*(scene.shapes[rng.integers(len(scene.kinds)), :3] - (x, y, z)).tolist())
        found, k = cast(scene, x, y, z, dx, dy, dz, 12.0)
        every = np.array([meet(scene, i, x, y, z, dx, dy, dz) for i in range(len(scene.kinds))])
        ground = -z / dz if dz < 0.0 else math.inf
        assert found == pytest.approx(min(every.min(), ground, 12.0), abs=1e-9)
        assert k == (NOTHING if found == 12.0 else GROUND if ground < every.min() else every.argmin())
        hits += k >= 0
    assert hits > 15


@pytest.mark.parametrize("d", [(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)])
def test_rays_along_the_axes_end_also_far_outside_the_grid(scene: RayScene, d: tuple[float, float, float]) -> None:
    assert cast(scene, 400.0, 500.0, 0.5, *d, 12.0) == ((0.5, GROUND) if d[2] < 0.0 else (12.0, NOTHING))


def test_an_empty_site_has_only_ground() -> None:
    bare = ray_scene(build_orchard(SiteMap(name="bare", datum=DATUM), OrchardParams()))
    away, met = cast(bare, 0.0, 0.0, 0.5, 0.8, 0.0, -0.6, 12.0)
    assert away == pytest.approx(0.5 / 0.6)
    assert met == GROUND
    assert cast(bare, 0.0, 0.0, 0.5, 1.0, 0.0, 0.0, 12.0) == (12.0, NOTHING)
