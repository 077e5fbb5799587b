"""What the rays of the simulated LiDAR meet lies where it is, seen from a robot that drives, turns and nods."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.geometry.lidar_mount import robot_lidar
from navcore.geometry.pinhole import robot_camera, rotation_from_rpy
from navcore.maps.site_map import Plant, PlantKind, Row, SiteMap, Warehouse
from navcore.messages import ObjectKind
from navcore.sim.camera_labels import LabelParams
from navcore.sim.camera_light import LightName, named_light
from navcore.sim.camera_renderer import CameraRenderer, RenderParams
from navcore.sim.lidar2d import FLAWLESS, Lidar2dParams
from navcore.sim.orchard import OrchardParams, Season, Trellis
from navcore.sim.planting import build_orchard
from navcore.sim.trunk_sections import trunk_sections
from tests.navcore.sim.lidar2d_turns import (
    DATUM,
    ROUNDED_M,
    STEP_NS,
    WALL_X,
    at,
    ends,
    lone_tree,
    shed_behind,
    turns,
)


def test_a_trunk_is_met_on_the_circle_that_it_is_at_that_height() -> None:
    tree = lone_tree(2.0, 0.7)
    (turn,) = turns(tree, FLAWLESS)
    x, y, r = trunk_sections(tree, robot_lidar().z)[0]
    hits = ends(turn.scan)
    assert len(hits) >= 10
    assert np.abs(np.hypot(hits[:, 0] - x, hits[:, 1] - y) - r).max() < ROUNDED_M
    assert set(np.array(turn.owners)[np.array(turn.scan.distances) > 0.0]) == {1}


def test_on_sloping_land_a_trunk_stands_upright_and_is_met_uphill_of_its_foot() -> None:
    level = lone_tree(2.0, 0.7)
    sloping = replace(level, uphill=(0.0, 0.14))
    (x, y, _), (up_x, up_y, up_r) = (trunk_sections(tree, robot_lidar().z)[0] for tree in (level, sloping))
    assert (up_x, up_y) == pytest.approx((x, y + 0.14 * robot_lidar().z), abs=1e-9)  # m
    hits = ends(turns(sloping, FLAWLESS)[0].scan)
    assert np.abs(np.hypot(hits[:, 0] - up_x, hits[:, 1] - up_y) - up_r).max() < 2e-3  # m: a tilted tube


def test_as_many_rays_meet_a_trunk_as_its_width_in_angle_asks_for() -> None:
    tree = lone_tree(2.5, 0.0)
    x, y, r = trunk_sections(tree, robot_lidar().z)[0]
    away = math.hypot(x - robot_lidar().x, y - robot_lidar().y)
    expected = 2.0 * math.asin(r / away) / (2.0 * math.pi / 1600)
    assert sum(d > 0.0 for d in turns(tree, FLAWLESS)[0].scan.distances) == pytest.approx(expected, abs=1.0)


def test_a_wall_is_a_straight_line_across() -> None:
    hits = ends(turns(shed_behind(), FLAWLESS)[0].scan)
    assert len(hits) > 400
    assert np.abs(hits[:, 0] - WALL_X).max() < ROUNDED_M
    assert np.ptp(hits[:, 1]) > 11.0  # m


def test_driving_to_a_wall_shortens_it_from_the_first_ray_to_the_last() -> None:
    (turn,) = turns(shed_behind(), FLAWLESS, drive=lambda k: at(k, x=-2.0 * k * 0.005, yaw=math.pi))
    d = turn.scan.distances
    assert d[0] - d[-1] == pytest.approx(2.0 * 0.1, abs=5e-4)  # m: 2 m/s for a turn


def test_turning_on_the_spot_moves_a_tree_by_what_the_robot_turned_until_then() -> None:
    tree, omega = lone_tree(-2.0, 0.1), 1.0
    (turn,) = turns(tree, FLAWLESS, drive=lambda k: at(k, yaw=omega * k * 0.005))
    a, d = np.array(turn.scan.angles), np.array(turn.scan.distances)
    seen = d > 0.0
    taken_s = np.flatnonzero(seen) / 16_000.0
    raw = robot_lidar().ends(a[seen], d[seen])[:, :2]
    c, s = np.cos(omega * taken_s), np.sin(omega * taken_s)
    x, y, r = trunk_sections(tree, robot_lidar().z)[0]
    turned = np.column_stack((c * raw[:, 0] - s * raw[:, 1], s * raw[:, 0] + c * raw[:, 1]))
    assert np.abs(np.hypot(turned[:, 0] - x, turned[:, 1] - y) - r).max() < ROUNDED_M
    assert np.hypot(*(raw.mean(axis=0) - (x, y))) > 0.08  # m: 0.05 rad at 2 m, uncorrected


def test_a_nodding_robot_sees_the_ground_where_its_plane_meets_it() -> None:
    empty, pitch = build_orchard(SiteMap(name="bare", datum=DATUM), OrchardParams()), 0.12
    (turn,) = turns(empty, FLAWLESS, drive=lambda k: at(k, pitch=pitch))
    hits = ends(turn.scan) @ rotation_from_rpy(0.0, pitch, 0.0).T
    assert len(hits) > 200
    assert np.abs(hits[:, 2]).max() < ROUNDED_M
    assert (hits[:, 0] > 0.0).all()


def test_edges_give_points_in_between_and_a_spot_without_width_gives_none() -> None:
    site = SiteMap(
        name="s", datum=DATUM, warehouse=Warehouse(x=0.0, y=0.0, yaw=0.0),
        plants=tuple(Plant(x=-1.0, y=0.5 * i, kind=PlantKind.POST) for i in range(-4, 5)),
    )  # fmt: skip
    orchard = build_orchard(site, OrchardParams())
    quiet = replace(FLAWLESS, strength=1000.0)

    def between(params: Lidar2dParams) -> int:
        return sum(
            int(((hits[:, 0] < -1.2) & (hits[:, 0] > WALL_X + 0.1)).sum())
            for hits in (ends(turn.scan) for turn in turns(orchard, params, 5))
        )

    assert between(quiet) == 0
    assert between(replace(quiet, beam_deg=0.25)) > 10


def test_camera_and_lidar_see_one_trunk_in_one_direction() -> None:
    site = SiteMap(name="s", datum=DATUM, rows=(Row(id="r", start=(-4.0, 0.0), end=(16.0, 0.0), width=2.6),))
    orchard = build_orchard(site, OrchardParams(season=Season.DORMANT, trellis=Trellis.VSP))
    truth, camera = at(0, 2.0, 0.1, 0.02), robot_camera()
    light = named_light(LightName.NOON)
    picture = CameraRenderer(orchard, camera, light, RenderParams(labels=LabelParams())).render(truth, 0)
    (turn,) = turns(orchard, FLAWLESS, drive=lambda k: replace(truth, stamp_ns=k * STEP_NS))
    owners = np.array(turn.owners)[np.array(turn.scan.distances) > 0.0]
    hits, c, s = ends(turn.scan), math.cos(truth.yaw), math.sin(truth.yaw)
    eye = np.array((truth.x + c * camera.x, truth.y + s * camera.x))
    matched = 0
    whole = [o for o in picture.objects if o.x1 > 0.0 and o.x2 < camera.width_px and o.visible > 0.8]
    for box in (o for o in whole if o.kind is ObjectKind.TRUNK and not o.ignore):
        trunk = int(np.abs(np.hypot(*(orchard.trunks[:, :2] - eye).T) - box.range).argmin())
        pixels = camera.project(hits[owners == trunk + 1])
        if len(pixels) >= 3:
            assert ((pixels[:, 0] > box.x1 - 1.0) & (pixels[:, 0] < box.x2 + 1.0)).all()  # px
            assert np.median(pixels[:, 0]) == pytest.approx((box.x1 + box.x2) / 2, abs=0.3 * (box.x2 - box.x1) + 1.0)
            matched += 1
    assert matched >= 5
