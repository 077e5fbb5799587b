"""The simulated LiDAR: true to geometry, late, noisy as told, and the same bits for the same seed."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from numpy.typing import NDArray

from navcore.errors import ContractError, InputError, NotFiniteError
from navcore.geometry.lidar_mount import robot_lidar
from navcore.geometry.pinhole import robot_camera, rotation_from_rpy
from navcore.maps.site_map import Datum, Plant, PlantKind, Row, SiteMap, Warehouse
from navcore.messages import LidarScan, ObjectKind, SimTruth
from navcore.sim.camera_labels import LabelParams
from navcore.sim.camera_light import LightName, named_light
from navcore.sim.camera_renderer import CameraRenderer, RenderParams
from navcore.sim.lidar2d import FLAWLESS, WORKING, Lidar2d, Lidar2dFaults, Lidar2dParams, SimScan
from navcore.sim.orchard import Orchard, OrchardParams, Season, Trellis
from navcore.sim.planting import build_orchard
from navcore.sim.trunk_sections import trunk_sections

Floats = NDArray[np.float64]
DATUM = Datum(lat_deg=41.0, lon_deg=-5.0, height_m=700.0)
STEP_NS = 5_000_000
REAL = Lidar2dParams()


def still(k: int) -> SimTruth:
    return at(k)


def at(k: int, x: float = 0.0, y: float = 0.0, yaw: float = 0.0, roll: float = 0.0, pitch: float = 0.0) -> SimTruth:
    return SimTruth(stamp_ns=k * STEP_NS, x=x, y=y, yaw=yaw, roll=roll, pitch=pitch, v=0.0, omega=0.0)


def lone_tree(x: float, y: float) -> Orchard:
    site = SiteMap(name="tree", datum=DATUM, plants=(Plant(x=x, y=y, kind=PlantKind.TRUNK),))
    return build_orchard(site, OrchardParams(season=Season.DORMANT, trellis=Trellis.TREES))


def shed_behind() -> Orchard:
    """A wall 12 m long across the x axis, its near face at x = -4.5 m, behind a robot parked at (0, 0)."""
    site = SiteMap(name="shed", datum=DATUM, warehouse=Warehouse(x=0.0, y=0.0, yaw=0.0))
    return build_orchard(site, OrchardParams())


WALL_X = -2.5
ROUNDED_M = 8e-5
"""A scan is told to 0.1 mm and 0.01 mrad: half of each, at up to 4 m, along and across a ray."""


def turns(
    orchard: Orchard, params: Lidar2dParams, count: int = 1, *, seed: int = 1, drive: object = still,
    faults: Lidar2dFaults = WORKING,
) -> list[SimScan]:  # fmt: skip
    lidar = Lidar2d(orchard, robot_lidar(), params, np.random.default_rng(seed))
    for k in range(20 * count + 1):
        lidar.update(drive(k), faults)  # type: ignore[operator]
    return list(lidar.due(10**15))


def ends(scan: LidarScan) -> Floats:
    """Where rays that came back end, (N, 3) in `base_link`."""
    a, d = np.array(scan.angles), np.array(scan.distances)
    return robot_lidar().ends(a[d > 0.0], d[d > 0.0])


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


def test_the_turn_is_clockwise_and_even_in_time() -> None:
    first, second = (turn.scan for turn in turns(shed_behind(), FLAWLESS, 2))
    assert np.diff(first.angles) == pytest.approx(np.full(1599, -math.radians(0.225)), abs=1.1e-5)  # rad, as rounded
    assert (first.began_ns, first.stamp_ns) == (0, 99_937_500)
    assert second.began_ns == 100_000_000
    assert first.distances == second.distances, "a robot that stands still sees the same again"


def test_a_turn_arrives_late_and_once() -> None:
    lidar = Lidar2d(shed_behind(), robot_lidar(), replace(REAL, latency_s=0.03), np.random.default_rng(1))
    for k in range(21):
        lidar.update(still(k))
    assert lidar.due(129_000_000) == ()
    assert len(lidar.due(130_000_000)) == 1
    assert lidar.due(130_000_000) == ()


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


def test_the_same_seed_gives_the_same_bits_however_often_the_pose_is_told() -> None:
    often = turns(shed_behind(), REAL, 3)
    lidar = Lidar2d(shed_behind(), robot_lidar(), REAL, np.random.default_rng(1))
    for k in range(0, 61, 4):
        lidar.update(still(k))
    assert often == list(lidar.due(10**15))
    assert often[0] != turns(shed_behind(), REAL, 1, seed=2)[0]


def test_noise_is_white_about_a_scale_that_is_each_devices_own() -> None:
    true = np.array(turns(shed_behind(), FLAWLESS)[0].scan.distances)
    near = (true > 0.0) & (true < 4.0)
    scales = []
    for seed in range(12):
        shares = []
        for turn in turns(shed_behind(), REAL, 2, seed=seed):
            d = np.array(turn.scan.distances)
            seen = near & (d > 0.0)
            shares.append((d / np.where(near, true, 1.0))[seen])
        assert np.std(shares[0]) == pytest.approx(0.004, rel=0.35)  # share of the distance
        assert np.mean(shares[0]) == pytest.approx(np.mean(shares[1]), abs=0.001)
        scales.append(np.mean(shares[0]) - 1.0)
    assert 0.004 < np.std(scales) < 0.016


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


def test_grazing_rays_and_far_bark_are_lost_first() -> None:
    true = np.array(turns(shed_behind(), FLAWLESS)[0].scan.distances)
    back = np.mean([np.array(t.scan.distances) > 0.0 for t in turns(shed_behind(), REAL, 10)], axis=0)
    square, grazing = (true > 0.0) & (true < 3.2), true > 5.5
    assert back[square].mean() > 0.98
    assert back[grazing].mean() < back[square].mean() - 0.03
    near, far = lone_tree(2.0, 0.0), lone_tree(11.0, 0.0)
    shares = []
    for tree in (near, far):
        there = np.array(turns(tree, FLAWLESS)[0].scan.distances) > 0.0
        shares.append(np.mean([np.array(t.scan.distances)[there] > 0.0 for t in turns(tree, REAL, 10)]))
    assert shares[0] > 0.9
    assert shares[1] < 0.6


def test_faults_break_what_they_say_at_any_instant() -> None:
    wall = shed_behind()
    lidar = Lidar2d(wall, robot_lidar(), REAL, np.random.default_rng(1))
    told: dict[str, list[SimScan]] = {}
    order = {
        "well": WORKING, "silent": Lidar2dFaults(silent=True), "zeros": Lidar2dFaults(zeros=True),
        "sun": Lidar2dFaults(sun=(math.pi, 0.3)), "well again": WORKING,
    }  # fmt: skip
    lidar.update(still(0))
    for i, (name, faults) in enumerate(order.items()):
        for k in range(40 * i + 1, 40 * i + 41):
            lidar.update(still(k), faults)
        told[name] = list(lidar.due(10**15))
    assert [len(scans) for scans in told.values()] == [2, 0, 2, 2, 2]
    assert set(told["zeros"][0].scan.distances) == {0.0}
    well, sun, again = (np.array(told[n][1].scan.distances) > 0.0 for n in ("well", "sun", "well again"))
    glare = np.abs(np.array(told["sun"][0].scan.angles) + math.pi) < 0.29
    assert well[glare].mean() > 0.95
    assert 0.0 < sun[glare].mean() < 0.15
    assert sun[~glare].sum() == pytest.approx(well[~glare].sum(), rel=0.1)
    assert again[glare].mean() > 0.95


def test_an_overturned_sensor_sees_left_and_right_exchanged() -> None:
    tree = lone_tree(2.0, 1.0)
    x, y, _ = trunk_sections(tree, robot_lidar().z)[0]
    (turn,) = turns(tree, FLAWLESS, faults=Lidar2dFaults(turned=(math.pi, 0.0, 0.0)))
    assert ends(turn.scan).mean(axis=0)[:2] == pytest.approx((x, -y), abs=0.1)  # m


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


def test_a_broken_pose_and_time_running_backwards_are_refused() -> None:
    lidar = Lidar2d(shed_behind(), robot_lidar(), REAL, np.random.default_rng(1))
    with pytest.raises(NotFiniteError):
        lidar.update(at(1, roll=math.nan))
    lidar.update(still(2))
    with pytest.raises(ContractError, match="backwards"):
        lidar.update(still(1))


@pytest.mark.parametrize("value", [math.nan, 4.0, 16.0])
def test_an_impossible_turn_rate_is_refused(value: float) -> None:
    with pytest.raises(InputError, match="turns_per_s"):
        Lidar2dParams(turns_per_s=value)


def test_fifteen_turns_a_second_have_coarser_angles() -> None:
    scans = turns(shed_behind(), replace(FLAWLESS, turns_per_s=15.0), 2)
    assert len(scans) == 3
    assert len(scans[0].scan.angles) == 1067
