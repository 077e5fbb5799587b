"""Weeds and stakes: none unless asked for, seen by camera and LiDAR, never taken for a trunk by the labels."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.errors import InputError
from navcore.geometry.lidar_mount import robot_lidar
from navcore.geometry.pinhole import robot_camera
from navcore.maps.site_map import Datum, Row, SiteMap
from navcore.messages import SimTruth
from navcore.sim.camera_labels import LabelParams
from navcore.sim.camera_light import LightName, named_light
from navcore.sim.camera_renderer import CameraRenderer, RenderedFrame, RenderParams
from navcore.sim.clutter import ClutterParams
from navcore.sim.lidar2d import FLAWLESS, Lidar2d
from navcore.sim.orchard import Orchard, OrchardParams, Season, Trellis
from navcore.sim.planting import build_orchard

SITE = SiteMap(
    name="s", datum=Datum(lat_deg=41.0, lon_deg=-5.0, height_m=700.0),
    rows=(Row(id="r", start=(0.0, 0.0), end=(20.0, 0.0), width=2.6),),
)  # fmt: skip
BARE = OrchardParams(season=Season.DORMANT, trellis=Trellis.VSP)
WEEDY = replace(BARE, clutter=ClutterParams(weeds_per_m=2.0, veiled_share=0.2, stake_share=0.5))
TRUTH = SimTruth(stamp_ns=0, x=4.0, y=0.0, yaw=0.0, roll=0.0, pitch=0.0, v=0.0, omega=0.0)


def picture(orchard: Orchard) -> RenderedFrame:
    light = named_light(LightName.OVERCAST)
    return CameraRenderer(orchard, robot_camera(), light, RenderParams(labels=LabelParams())).render(TRUTH, 0)


def test_nothing_is_cluttered_unless_asked_for() -> None:
    clutter = build_orchard(SITE, OrchardParams()).clutter
    assert (clutter.weeds.shape, clutter.stakes.shape) == ((0, 4), (0, 6))


def test_clutter_leaves_all_that_is_planted_as_it_was() -> None:
    bare, weedy = build_orchard(SITE, BARE), build_orchard(SITE, WEEDY)
    assert bare.trunks.tobytes() == weedy.trunks.tobytes()
    assert bare.posts.tobytes() == weedy.posts.tobytes()
    again = build_orchard(SITE, WEEDY).clutter
    assert weedy.clutter.weeds.tobytes() == again.weeds.tobytes()
    assert weedy.clutter.stakes.tobytes() == again.stakes.tobytes()


def test_as_much_grows_as_was_asked_for() -> None:
    orchard = build_orchard(SITE, WEEDY)
    weeds, stakes, trunks = orchard.clutter.weeds, orchard.clutter.stakes, orchard.trunks
    assert len(weeds) == pytest.approx(2 * 20 * 2.0 + 0.2 * len(trunks), abs=8)
    assert len(stakes) == pytest.approx(0.5 * len(trunks), abs=8)
    assert 0.2 <= weeds[:, 2].min() <= weeds[:, 2].max() <= 0.9  # m
    assert 0.005 <= stakes[:, 3].min() <= stakes[:, 3].max() <= 0.015  # m
    nearest = np.hypot(*(stakes[:, None, :2] - trunks[None, :, :2]).transpose(2, 0, 1)).min(axis=1)
    assert nearest.min() > trunks[:, 4].min()
    assert nearest.max() < 0.3  # m


def test_the_camera_sees_clutter_and_labels_none_of_it() -> None:
    bare, weedy = picture(build_orchard(SITE, BARE)), picture(build_orchard(SITE, WEEDY))
    assert (bare.image != weedy.image).any(axis=2).mean() > 0.005
    assert {(o.kind, o.range) for o in weedy.objects} <= {(o.kind, o.range) for o in bare.objects}
    assert max(o.visible for o in weedy.objects) <= 1.0


def test_the_lidar_meets_stakes_and_weeds_and_calls_them_nothing() -> None:
    orchard = build_orchard(SITE, WEEDY)
    lidar = Lidar2d(orchard, robot_lidar(), FLAWLESS, np.random.default_rng(1))
    for k in range(21):
        lidar.update(replace(TRUTH, stamp_ns=k * 5_000_000))
    (turn,) = lidar.due(10**12)
    a, d, owners = np.array(turn.scan.angles), np.array(turn.scan.distances), np.array(turn.owners)
    other = (d > 0.0) & (owners == 0)
    hits = robot_lidar().ends(a[other], d[other])[:, :2] + (TRUTH.x, TRUTH.y)
    s = orchard.clutter.stakes
    axis = s[:, :2] + s[:, 4:6] * (robot_lidar().z / s[:, 2])[:, None]
    to_stake = np.hypot(*(hits[:, None] - axis[None]).transpose(2, 0, 1)) - s[:, 3]
    on_stake = np.abs(to_stake).min(axis=1) < 0.004  # m: the foot is sunk 4 cm
    w = orchard.clutter.weeds
    to_weed = np.hypot(*(hits[:, None] - w[None, :, :2]).transpose(2, 0, 1)) - w[:, 3]
    assert on_stake.sum() >= 3
    assert (to_weed.min(axis=1) < 0.12).sum() >= 3  # m: leaves reach beyond their stalks
    assert (on_stake | (to_weed.min(axis=1) < 0.12)).all()


@pytest.mark.parametrize(
    ("name", "value"), [("weeds_per_m", math.nan), ("stake_share", 1.1), ("weed_height", (0.8, 0.2))]
)
def test_impossible_clutter_is_refused(name: str, value: object) -> None:
    with pytest.raises(InputError, match=name):
        ClutterParams(**{name: value})  # type: ignore[arg-type]
