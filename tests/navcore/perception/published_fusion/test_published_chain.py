"""Paper B's chains see the row that is there, and say why when there is none."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from navcore.errors import ConfigError, NotFiniteError
from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.se2 import SE2
from navcore.messages import CameraName, DetectedObject, LidarScan
from navcore.perception.published_fusion.published_chain import (
    LidarRansac,
    PublishedFusion,
    PublishedFusionParams,
    RowChain,
    VisionRansac,
)
from navcore.perception.published_fusion.ray_projection import (
    camera_centre,
    distances_from_rays,
    lidar_plane,
    on_plane,
    pixel_rays,
    plane_crossings,
)
from navcore.perception.scan.scan_points import ScanPointsParams, scan_points
from tests.navcore.perception.published_fusion.orchard import CAMERA, LIDAR, Corridor

PARAMS = PublishedFusionParams()
POSE = SE2(3.0, 0.12, 0.03)
CHAINS: dict[str, RowChain] = {
    "fused": PublishedFusion(CAMERA, LIDAR, PARAMS),
    "LiDAR": LidarRansac(PARAMS),
    "vision": VisionRansac(CAMERA, PARAMS),
}


def nothing() -> LidarScan:
    return LidarScan(stamp_ns=1, began_ns=0, angles=(0.0, 1.0, 2.0), distances=(0.0, 0.0, 0.0))


@pytest.mark.parametrize("name", CHAINS)
def test_the_row_is_where_it_is(name: str) -> None:
    CHAINS[name].forget()
    rng = np.random.default_rng(5)
    boxes, _, scan = Corridor.planted(rng).seen(POSE, rng)
    row = CHAINS[name].process(7, boxes, scan_points(scan, LIDAR, ScanPointsParams())).found.row
    assert (row.valid, row.reason, row.stamp_ns) == (True, "", 7)
    assert row.offset == pytest.approx(-POSE.y, abs=0.12)  # m
    assert row.heading == pytest.approx(-POSE.yaw, abs=0.05)  # rad
    assert row.width == pytest.approx(2.5, abs=0.2)  # m
    assert row.left_seen
    assert row.right_seen


def test_boxes_get_the_trunk_that_they_show() -> None:
    rng = np.random.default_rng(6)
    corridor = Corridor.planted(rng)
    boxes, shown, scan = corridor.seen(POSE, rng)
    view = PublishedFusion(CAMERA, LIDAR, PARAMS).process(0, boxes, scan_points(scan, LIDAR, ScanPointsParams()))
    places = [POSE.apply_point(t.x, t.y) if t else None for t in view.associations]
    off = [math.dist(at, corridor.trunks[k, :2]) for at, k in zip(places, shown, strict=True) if at]
    assert len(off) >= 0.6 * len(boxes)
    assert np.mean(np.array(off) < 0.15) > 0.85  # m


def test_no_scan_gives_no_trunk_and_says_so() -> None:
    rng = np.random.default_rng(5)
    boxes, _, _ = Corridor.planted(rng).seen(POSE, rng)
    silent = scan_points(nothing(), LIDAR, ScanPointsParams())
    view = PublishedFusion(CAMERA, LIDAR, PARAMS).process(0, boxes, silent)
    assert view.associations == (None,) * len(view.objects)
    assert "LiDAR sees nothing" in view.found.row.reason
    assert not LidarRansac(PARAMS).process(0, boxes, silent).found.row.valid
    assert VisionRansac(CAMERA, PARAMS).process(0, boxes, silent).found.row.valid


def test_no_box_gives_no_row_by_camera_and_unsure_ones_neither() -> None:
    rng = np.random.default_rng(5)
    boxes, _, scan = Corridor.planted(rng).seen(POSE, rng)
    points = scan_points(scan, LIDAR, ScanPointsParams())
    unsure = [replace(box, confidence=0.2) for box in boxes]
    for seen in ([], unsure):
        row = PublishedFusion(CAMERA, LIDAR, PARAMS).process(0, seen, points).found.row
        assert (row.valid, row.reason) == (False, "no line of plants on either side")


def test_a_rear_camera_sees_the_row_its_own_way() -> None:
    """Everything turned by half a turn: the driving frame sees the same."""
    rng = np.random.default_rng(5)
    boxes, _, scan = Corridor.planted(rng).seen(POSE, rng)
    rear = replace(CAMERA, x=-CAMERA.x, y=-CAMERA.y, yaw=math.pi)
    turned = LidarMount(x=-LIDAR.x, y=-LIDAR.y, z=LIDAR.z, yaw=math.pi)
    views = [
        PublishedFusion(camera, mount, PARAMS).process(0, boxes, scan_points(scan, mount, ScanPointsParams()))
        for camera, mount in ((CAMERA, LIDAR), (rear, turned))
    ]
    front, back = (view.found.row for view in views)
    assert back.camera is CameraName.REAR
    assert back.offset == pytest.approx(front.offset)
    assert back.heading == pytest.approx(front.heading)


def test_a_box_that_is_no_number_is_refused() -> None:
    rng = np.random.default_rng(5)
    boxes, _, scan = Corridor.planted(rng).seen(POSE, rng)
    bad: list[DetectedObject] = [replace(boxes[0], x1=math.nan)]
    for chain in (PublishedFusion(CAMERA, LIDAR, PARAMS), VisionRansac(CAMERA, PARAMS)):
        with pytest.raises(NotFiniteError, match="detector"):
            chain.process(0, bad, scan_points(scan, LIDAR, ScanPointsParams()))


def test_a_pixels_ray_goes_through_what_it_shows() -> None:
    point = np.array([[4.0, 1.1, 0.6]])
    ray = pixel_rays(CAMERA, CAMERA.project(point))
    assert distances_from_rays(camera_centre(CAMERA), ray, point)[0] < 1e-6  # m
    aside = point + 0.2 * np.cross(ray, (0.0, 0.0, 1.0)) / np.linalg.norm(np.cross(ray, (0.0, 0.0, 1.0)))
    assert distances_from_rays(camera_centre(CAMERA), ray, aside)[0] == pytest.approx(0.2)  # m
    assert math.isinf(distances_from_rays(camera_centre(CAMERA), ray, -point)[0])


def test_rays_cross_the_lidars_plane_where_they_rise_above_it_only() -> None:
    plane = lidar_plane(LIDAR)
    on = on_plane(np.array([[3.0, -1.0]]), plane)
    assert on[0, 2] == pytest.approx(LIDAR.z)
    rays = pixel_rays(CAMERA, np.vstack((CAMERA.project(on), [[660.0, 500.0]])))
    crossings = plane_crossings(camera_centre(CAMERA), rays, plane)
    assert crossings[0] == pytest.approx(on[0])
    assert np.isnan(crossings[1]).all()


def test_one_pixel_moves_the_crossing_by_decimetres() -> None:
    """The published trap: the camera sits 9.6 cm below the plane."""
    u, v = CAMERA.project(np.array([[CAMERA.x + 3.0, 0.0, LIDAR.z]]))[0]
    rays = pixel_rays(CAMERA, np.array([[u, v], [u, v + 1.0]]))
    near, far = plane_crossings(camera_centre(CAMERA), rays, lidar_plane(LIDAR))
    assert 0.10 < math.dist(near, far) < 0.20  # m


def test_an_upside_down_lidar_sweeps_the_same_plane_and_one_on_its_side_is_refused() -> None:
    assert lidar_plane(replace(LIDAR, roll=math.pi)) == pytest.approx(lidar_plane(LIDAR))
    with pytest.raises(ConfigError, match="on its side"):
        lidar_plane(replace(LIDAR, roll=math.pi / 2))
