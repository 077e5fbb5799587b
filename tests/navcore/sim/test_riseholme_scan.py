"""A surveyed vineyard, scanned along a recorded drive: its posts come back where the survey has them."""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.geodesy import EnuFrame
from navcore.geometry.lidar_mount import robot_lidar
from navcore.maps.geojson import import_site
from navcore.maps.site_map import SiteMap
from navcore.maps.survey import vines_from_csv
from navcore.messages import SimTruth
from navcore.sim.lidar2d import Lidar2d, Lidar2dParams, SimScan
from navcore.sim.orchard import Orchard, OrchardParams, PostKind, Season, Trellis
from navcore.sim.planting import build_orchard

Floats = NDArray[np.float64]
STEP_NS = 5_000_000
NEAR_M = 6.0


def vineyard(folder: Path) -> SiteMap:
    """Surveyed posts and vines, and rows between the lines of posts."""
    site = import_site(json.loads((folder / "riseholme_rtk_gps_poles.geojson").read_text())).site
    vines = vines_from_csv((folder / "riseholme_vineyard_lat_long_vines.csv").read_text(), EnuFrame(site.datum))
    return replace(site, plants=(*site.plants, *vines))


def recorded_poses(folder: Path, site: SiteMap) -> list[Floats]:
    """Stretches of the drive within rows without a jump: (N, 4) seconds, x, y in `map` and yaw along the way."""
    table = np.genfromtxt(folder / "tue02sep.csv", delimiter=",", names=True)
    east, north, _ = EnuFrame(site.datum).to_enu(53.26810042662116, -0.5244249078498293, site.datum.height_m)
    drive = np.column_stack((table["t_s"], table["x_m"] + east, table["y_m"] + north))
    moved = np.hypot(*np.diff(drive[:, 1:], axis=0).T)
    cut = np.flatnonzero((moved > 0.5) | (np.diff(table["pass_id"]) != 0)) + 1
    stretches = [s for s in np.split(np.column_stack((drive, table["pass_id"])), cut) if s[0, 3] >= 0]
    return [_heading(s[:, :3]) for s in stretches if np.hypot(*(s[-1, 1:3] - s[0, 1:3])) > 4.0]


def _heading(stretch: Floats) -> Floats:
    """With the yaw along the way, of poses at least 0.2 m apart."""
    kept = [0]
    for i in range(1, len(stretch)):
        if math.dist(stretch[i, 1:], stretch[kept[-1], 1:]) > 0.2:
            kept.append(i)
    poses = stretch[kept]
    yaw = np.unwrap(np.arctan2(np.gradient(poses[:, 2]), np.gradient(poses[:, 1])))
    return np.column_stack((poses, yaw))


def truth(poses: Floats, t: float, stamp_ns: int) -> SimTruth:
    x, y, yaw = (float(np.interp(t, poses[:, 0], poses[:, i])) for i in (1, 2, 3))
    return SimTruth(stamp_ns=stamp_ns, x=x, y=y, yaw=yaw, roll=0.0, pitch=0.0, v=0.0, omega=0.0)


def scanned(orchard: Orchard, poses: Floats, seed: int) -> list[SimScan]:
    """Turns along a stretch of the drive; its stamps count from the stretch's beginning."""
    lidar = Lidar2d(orchard, robot_lidar(), Lidar2dParams(), np.random.default_rng(seed))
    for k in range(int((poses[-1, 0] - poses[0, 0]) * 1e9 / STEP_NS)):
        lidar.update(truth(poses, poses[0, 0] + k * STEP_NS * 1e-9, k * STEP_NS))
    return list(lidar.due(10**15))


def middles(turn: SimScan, poses: Floats, trunks: int, radius: float) -> list[tuple[int, Floats]]:
    """Per post met near by: its number and where its middle must be, in `map`, each ray from its own pose."""
    scan, owners = turn.scan, np.array(turn.owners)
    distances = np.array(scan.distances)
    rays = np.flatnonzero((owners > trunks) & (distances > 0.0) & (distances < NEAR_M))
    took_ns = (scan.stamp_ns - scan.began_ns) / (len(distances) - 1)
    found = []
    for i in rays:
        at = truth(poses, poses[0, 0] + (scan.began_ns + i * took_ns) * 1e-9, 0)
        bearing = at.yaw + scan.angles[i]
        reach = distances[i] + radius
        c, s = math.cos(at.yaw), math.sin(at.yaw)
        x = at.x + c * robot_lidar().x + reach * math.cos(bearing)
        y = at.y + s * robot_lidar().x + reach * math.sin(bearing)
        found.append((int(owners[i]) - trunks - 1, np.array((x, y))))
    return found


def test_the_posts_come_back_within_5_cm_of_the_survey(shared_data: Path) -> None:
    folder = shared_data / "riseholme"
    site = vineyard(folder)
    params = OrchardParams(trellis=Trellis.VSP, season=Season.DORMANT, posts=PostKind.WOOD)
    orchard = build_orchard(site, params)
    assert (len(orchard.posts), len(orchard.trunks)) == (40, 120)
    seen: dict[int, list[Floats]] = {}
    for seed, poses in enumerate(recorded_poses(folder, site)[:3]):
        for turn in scanned(orchard, poses, seed):
            for post, middle in middles(turn, poses, len(orchard.trunks), params.post_radius):
                seen.setdefault(post, []).append(middle)
    often = {post: np.array(places) for post, places in seen.items() if len(places) >= 20}
    assert len(often) >= 6
    off = [math.dist(places.mean(axis=0), orchard.posts[post, :2]) for post, places in often.items()]
    hits = np.concatenate([np.hypot(*(p - orchard.posts[post, :2]).T) for post, p in often.items()])
    assert np.mean(off) < 0.05  # m
    assert np.mean(hits) < 0.05  # m
