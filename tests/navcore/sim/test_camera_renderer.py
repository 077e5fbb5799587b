"""The simulated camera: true to the pinhole, true to its seed, and the labels true to the picture."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.geometry.pinhole import robot_camera, rotation_from_rpy
from navcore.maps.site_map import Datum, Lane, Row, SiteMap
from navcore.messages import ObjectKind, SimTruth
from navcore.sim.camera_labels import LabelParams, RenderedObject
from navcore.sim.camera_light import LightName, LightParams, named_light
from navcore.sim.camera_renderer import CameraRenderer, RenderedFrame, RenderParams, Scene
from navcore.sim.orchard import Orchard, OrchardParams, Season, Trellis
from navcore.sim.planting import build_orchard
from navcore.sim.render.ground import GroundTint

DATUM = Datum(lat_deg=41.0, lon_deg=-5.0, height_m=700.0)
LABELLED = RenderParams(labels=LabelParams())
QUIET = replace(named_light(LightName.NOON), noise=0.0, blur_px=0.0)


def farm(angle: float = 0.0) -> SiteMap:
    """Two rows of 3 m by 40 m, turned about the origin."""
    c, s = math.cos(angle), math.sin(angle)
    rows = tuple(
        Row(id=f"r{i}", start=(-3.0 * i * s, 3.0 * i * c), end=(40 * c - 3.0 * i * s, 40 * s + 3.0 * i * c))
        for i in range(2)
    )
    return SiteMap(name="farm", datum=DATUM, rows=rows)


def orchard(season: Season = Season.DORMANT, trellis: Trellis = Trellis.VSP, angle: float = 0.0) -> Orchard:
    return build_orchard(
        farm(angle), OrchardParams(season=season, trellis=trellis, scatter_std=0.0, missing_share=0.0)
    )


def at(x: float, y: float = 0.0, yaw: float = 0.0, roll: float = 0.0, pitch: float = 0.0) -> SimTruth:
    return SimTruth(stamp_ns=0, x=x, y=y, yaw=yaw, roll=roll, pitch=pitch, v=0.0, omega=0.0)


def shot(
    place: Orchard, truth: SimTruth, light: LightParams = QUIET, frame: int = 0, *, rear: bool = False
) -> RenderedFrame:
    camera, sky = robot_camera(rear=rear), replace(light, exposure=0.72, red_gain=1.0, lamp=1.0)
    return CameraRenderer(place, camera, light, LABELLED, scene=scene_of(place, sky)).render(truth, frame)


@lru_cache(maxsize=4)
def scene_of(place: Orchard, sky: LightParams) -> Scene:
    """Scenes are slow to build; exposure, white balance and lamp are the camera's and the robot's own."""
    return Scene(place, sky)


def counted(frame: RenderedFrame) -> list[RenderedObject]:
    return [o for o in frame.objects if not o.ignore]


def brightness(image: NDArray[np.uint8]) -> float:
    return float(image.mean())


@pytest.fixture(scope="module")
def dormant() -> Orchard:
    return orchard()


def test_same_seed_and_frame_give_the_same_bits_whatever_was_drawn_before(dormant: Orchard) -> None:
    light = named_light(LightName.AFTERNOON)
    fresh = CameraRenderer(dormant, robot_camera(), light, LABELLED)
    travelled = CameraRenderer(dormant, robot_camera(), light, LABELLED)
    for i, x in enumerate((0.0, 30.0, 90.0)):
        travelled.render(at(x), i)
    a, b = fresh.render(at(10.0, 0.1, 0.05), 7), travelled.render(at(10.0, 0.1, 0.05), 7)
    assert a.image.tobytes() == b.image.tobytes()
    assert a.objects == b.objects


def test_noise_differs_from_frame_to_frame_and_the_labels_do_not(dormant: Orchard) -> None:
    renderer = CameraRenderer(dormant, robot_camera(), named_light(LightName.NOON), LABELLED)
    a, b = renderer.render(at(10.0), 1), renderer.render(at(10.0), 2)
    assert a.image.tobytes() != b.image.tobytes()
    assert a.objects == b.objects


@pytest.mark.parametrize(("roll", "pitch"), [(0.0, 0.0), (0.03, -0.02)])
def test_feet_in_the_picture_are_where_the_pinhole_puts_the_surveyed_posts(
    dormant: Orchard, roll: float, pitch: float
) -> None:
    truth, camera = at(10.0, 0.3, 0.1, roll, pitch), robot_camera()
    posts = dormant.posts[:, :3] - (truth.x, truth.y, 0.0)
    expected = camera.project(posts @ rotation_from_rpy(roll, pitch, truth.yaw))
    near = [o for o in shot(dormant, truth).objects if o.kind is ObjectKind.POST and o.range < 15.0]
    assert len(near) >= 3
    for post in near:
        assert np.nanmin(np.hypot(expected[:, 0] - post.foot_u, expected[:, 1] - post.foot_v)) < 0.1


def test_boxes_stand_on_the_feet_they_claim_to_show(dormant: Orchard) -> None:
    standing = [o for o in counted(shot(dormant, at(10.0))) if o.foot_visible]
    assert len(standing) >= 8
    for o in standing:
        assert o.x1 - 2.0 <= o.foot_u <= o.x2 + 2.0
        assert abs(o.y2 - o.foot_v) <= max(2.0, 0.04 * 2 * (o.y2 - o.y1))


def test_nothing_far_small_or_hidden_counts(dormant: Orchard) -> None:
    frame = shot(dormant, at(5.0))
    assert any(o.ignore for o in frame.objects)
    for o in counted(frame):
        assert o.range <= 12.0
        assert o.visible >= 0.4
        assert o.y2 - o.y1 >= 14.0
        assert o.rows_nearer in (0, 1)


def test_labels_can_be_switched_off(dormant: Orchard) -> None:
    assert CameraRenderer(dormant, robot_camera(), QUIET).render(at(5.0), 0).objects == ()


def test_the_rear_camera_sees_what_the_front_camera_sees_when_the_robot_is_turned(dormant: Orchard) -> None:
    rear, front = shot(dormant, at(20.0), rear=True), shot(dormant, at(20.0, 0.0, math.pi))
    assert np.abs(rear.image.astype(int) - front.image.astype(int)).mean() < 1.0
    assert [(o.kind, round(o.range, 6)) for o in rear.objects] == [(o.kind, round(o.range, 6)) for o in front.objects]


@pytest.mark.parametrize("angle", [0.7, -2.2])
def test_rows_in_any_direction_look_alike_from_within(dormant: Orchard, angle: float) -> None:
    straight = [o for o in counted(shot(dormant, at(10.0))) if o.kind is ObjectKind.POST]
    c, s = math.cos(angle), math.sin(angle)
    turned = shot(orchard(angle=angle), at(10.0 * c, 10.0 * s, angle)).objects
    for post in straight:
        assert min(math.hypot(o.foot_u - post.foot_u, o.foot_v - post.foot_v) for o in turned) < 0.1


def test_a_roof_of_leaves_hides_the_sky_that_a_bare_one_shows() -> None:
    def blue_above(season: Season) -> float:
        image = shot(orchard(season, Trellis.ROOF), at(10.0)).image[:120].astype(int)
        return float(np.mean(image[..., 0] > image[..., 1]))

    assert blue_above(Season.DORMANT) > blue_above(Season.MATURING) + 0.25


def test_leaves_throw_shadows_at_noon_and_none_under_clouds() -> None:
    def contrast(light: LightName) -> float:
        frame = shot(orchard(Season.MATURING, Trellis.ROOF), at(10.0), replace(named_light(light), noise=0.0))
        ground = frame.image[220:].mean(axis=2)
        return float(ground.std() / ground.mean())

    assert contrast(LightName.NOON) > 1.25 * contrast(LightName.OVERCAST)


def test_at_night_the_lamp_lights_what_is_near(dormant: Orchard) -> None:
    night = named_light(LightName.NIGHT)
    lit, dark = shot(dormant, at(10.0), night).image, shot(dormant, at(10.0), replace(night, lamp=0.0)).image
    assert brightness(lit[260:]) > 3.0 * brightness(dark[260:])
    assert brightness(lit[150:200]) < brightness(lit[260:])


def test_exposure_brightens_and_white_balance_tints(dormant: Orchard) -> None:
    plain = shot(dormant, at(10.0)).image
    assert brightness(shot(dormant, at(10.0), replace(QUIET, exposure=1.2)).image) > brightness(plain) + 10.0
    red = shot(dormant, at(10.0), replace(QUIET, red_gain=1.4)).image
    assert red[..., 2].mean() > plain[..., 2].mean() + 5.0
    assert red[..., 1].mean() == pytest.approx(plain[..., 1].mean(), abs=0.01)


def test_the_road_stands_out_from_the_field() -> None:
    site = SiteMap(name="road", datum=DATUM, lanes=(Lane(id="l", points=((0.0, 0.0), (60.0, 0.0))),))
    image = shot(build_orchard(site, OrchardParams()), at(10.0)).image.astype(int)
    road, field = image[300:, 280:360].mean(axis=(0, 1)), image[200:230, :60].mean(axis=(0, 1))
    assert np.abs(road - field).max() > 10.0


def test_the_ground_takes_the_colours_of_the_orthophoto() -> None:
    bare = build_orchard(SiteMap(name="bare", datum=DATUM), OrchardParams())
    red = np.full((80, 80, 3), (200, 40, 40), dtype=np.uint8)
    red[:, 40:] = (40, 40, 200)
    scene = Scene(bare, QUIET, GroundTint(colour=red, x=-40.0, y=-40.0, per_m=1.0))
    west = CameraRenderer(bare, robot_camera(), QUIET, scene=scene).render(at(-30.0), 0).image[300:].mean(axis=(0, 1))
    east = CameraRenderer(bare, robot_camera(), QUIET, scene=scene).render(at(5.0), 0).image[300:].mean(axis=(0, 1))
    assert west[2] > west[0] + 30.0
    assert east[0] > east[2] + 30.0


def test_an_empty_site_is_ground_and_sky() -> None:
    frame = shot(build_orchard(SiteMap(name="bare", datum=DATUM), OrchardParams()), at(0.0))
    assert frame.objects == ()
    assert frame.image[:60, :, 0].mean() > frame.image[300:, :, 0].mean()


def test_two_cameras_may_share_a_scene(dormant: Orchard) -> None:
    scene = Scene(dormant, QUIET)
    CameraRenderer(dormant, robot_camera(), QUIET, scene=scene).render(at(0.0), 0)
    shared = CameraRenderer(dormant, robot_camera(rear=True), QUIET, LABELLED, scene=scene).render(at(20.0), 3)
    alone = CameraRenderer(dormant, robot_camera(rear=True), QUIET, LABELLED).render(at(20.0), 3)
    assert shared.image.tobytes() == alone.image.tobytes()


def test_the_published_resolution_is_possible(dormant: Orchard) -> None:
    camera = robot_camera(width_px=1280, height_px=720)
    frame = CameraRenderer(dormant, camera, QUIET, LABELLED, scene=scene_of(dormant, QUIET)).render(at(10.0), 0)
    assert frame.image.shape == (720, 1280, 3)
    small = {(o.kind, o.range) for o in counted(shot(dormant, at(10.0)))}
    assert small <= {(o.kind, o.range) for o in frame.objects}


@pytest.mark.parametrize("value", [float("nan"), 0.0, 50.0])
def test_an_impossible_exposure_is_refused(value: float) -> None:
    with pytest.raises(InputError, match="exposure"):
        LightParams(exposure=value)
