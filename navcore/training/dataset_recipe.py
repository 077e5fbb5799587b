"""What random training pictures show: farm, season, light, pose and how the camera answers."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from navcore.geometry.pinhole import PinholeCamera, robot_camera
from navcore.maps.site_map import Row, SiteMap
from navcore.messages import SimTruth
from navcore.sim.camera_light import LightName, LightParams, named_light
from navcore.sim.layouts import LayoutParams, tuning_layout
from navcore.sim.orchard import Orchard, OrchardParams, PostKind, Season, Trellis
from navcore.sim.planting import build_orchard

LAYOUTS = LayoutParams(
    rows=(3, 6), row_length=(30.0, 75.0), row_width=(2.2, 4.2), post_spacing=(3.5, 8.0), plant_spacing=(0.9, 2.6)
)
LAYOUTS_PER_SEED = 10_000
_TRELLIS = {Trellis.ROOF: 0.45, Trellis.VSP: 0.4, Trellis.TREES: 0.15}
_LIGHT = {
    LightName.NOON: 0.2, LightName.AFTERNOON: 0.22, LightName.EVENING: 0.13, LightName.BACKLIT: 0.15,
    LightName.OVERCAST: 0.18, LightName.NIGHT: 0.12,
}  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SceneRecipe:
    """A random farm in a random light."""

    site: SiteMap
    orchard: Orchard
    light_name: LightName
    light: LightParams


@dataclass(frozen=True, slots=True, kw_only=True)
class ShotRecipe:
    """A random picture of a scene; `place` tells where: row, entry, end or lane."""

    place: str
    truth: SimTruth
    camera: PinholeCamera
    light: LightParams
    jpeg_quality: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Setting:
    """What all scenes of a set have in common; None: each its own."""

    season: Season | None = None
    light: LightName | None = None


def random_scene(seed: int, number: int, setting: Setting = Setting()) -> SceneRecipe:
    """Scene `number` of a set. Sets of different seeds share no farm, and none is a farm that benches score on."""
    rng = np.random.default_rng((seed, number, 29))
    site = tuning_layout(LAYOUTS_PER_SEED * (seed + 1) + number, LAYOUTS)
    orchard = build_orchard(site, _orchard_params(setting.season, rng))
    drawn = LightName(_pick(_LIGHT, rng))
    name = setting.light or drawn
    row = site.rows[0]
    along = math.atan2(row.end[1] - row.start[1], row.end[0] - row.start[0]) + math.pi * float(rng.integers(2))
    return SceneRecipe(site=site, orchard=orchard, light_name=name, light=_light(name, along, rng))


def _pick(shares: dict[Trellis, float] | dict[LightName, float], rng: np.random.Generator) -> str:
    return str(rng.choice([str(k) for k in shares], p=list(shares.values())))


def _orchard_params(wanted: Season | None, rng: np.random.Generator) -> OrchardParams:
    drawn = list(Season)[int(rng.integers(len(Season)))]
    season = wanted or drawn
    return OrchardParams(
        seed=int(rng.integers(1 << 31)), season=season, trellis=Trellis(_pick(_TRELLIS, rng)),
        posts=list(PostKind)[int(rng.integers(len(PostKind)))], scatter_std=float(rng.uniform(0.01, 0.08)),
        missing_share=float(rng.uniform(0.0, 0.15)), trunk_radius=float(rng.uniform(0.02, 0.06)),
        post_radius=float(rng.uniform(0.03, 0.06)), leaf_density=_leaf_density(season, rng),
    )  # fmt: skip


def _leaf_density(season: Season, rng: np.random.Generator) -> float | None:
    return None if season is Season.DORMANT else float(rng.uniform(0.15, 1.0))


def _light(name: LightName, along: float, rng: np.random.Generator) -> LightParams:
    """A named light with the sun and clouds moved about."""
    light = named_light(name, along=along, seed=int(rng.integers(1 << 31)))
    turn = rng.normal(0.0, 0.15) if name is LightName.BACKLIT else rng.uniform(-math.pi, math.pi)
    return replace(
        light, sun_azimuth=math.remainder(light.sun_azimuth + turn, 2 * math.pi),
        sun_elevation=float(np.clip(light.sun_elevation * rng.uniform(0.75, 1.25), 0.12, 1.3)),
        cloud=float(np.clip(light.cloud + rng.normal(0.0, 0.12), 0.0, 1.0)), lamp=float(rng.uniform(0.6, 1.8)),
        haze_per_m=float(rng.uniform(0.001, 0.009)),
    )  # fmt: skip


def random_shot(scene: SceneRecipe, rng: np.random.Generator) -> ShotRecipe:
    """A random picture: mostly in the row, some at its entry and end, some on lanes."""
    row = scene.site.rows[int(rng.integers(len(scene.site.rows)))]
    place = str(rng.choice(("row", "entry", "end", "lane"), p=(0.62, 0.16, 0.12, 0.10)))
    x, y, yaw = _on_lane(scene.site, rng) if place == "lane" else _near_row(row, place, rng)
    rear = bool(rng.random() < 0.3)
    truth = SimTruth(
        stamp_ns=0, x=x, y=y, yaw=math.remainder(yaw + math.pi * rear, 2 * math.pi),
        roll=float(rng.normal(0.0, 0.02)), pitch=float(rng.normal(0.0, 0.02)), v=0.0, omega=0.0,
    )  # fmt: skip
    return ShotRecipe(
        place=place, truth=truth, camera=_camera(rear, rng), light=_exposed(scene.light, rng),
        jpeg_quality=int(rng.integers(55, 97)),
    )  # fmt: skip


def _near_row(row: Row, place: str, rng: np.random.Generator) -> tuple[float, float, float]:
    """Position and direction of view; forward and backward along the row are alike."""
    (x0, y0), (x1, y1) = (row.start, row.end) if rng.random() < 0.5 else (row.end, row.start)
    length, yaw = math.hypot(x1 - x0, y1 - y0), math.atan2(y1 - y0, x1 - x0)
    if place == "entry":
        along, left, turn = rng.uniform(-6.0, 0.0), rng.normal(0.0, 0.6), rng.normal(0.0, math.radians(12.0))
    elif place == "end":
        along, left, turn = length - rng.uniform(-1.0, 9.0), rng.normal(0.0, 0.3), rng.normal(0.0, math.radians(6.0))
    else:
        along, left = rng.uniform(0.0, length), rng.uniform(-0.6, 0.6)
        turn = rng.uniform(-1.0, 1.0) * math.radians(15.0)
    c, s = math.cos(yaw), math.sin(yaw)
    return float(x0 + along * c - left * s), float(y0 + along * s + left * c), float(yaw + turn)


def _on_lane(site: SiteMap, rng: np.random.Generator) -> tuple[float, float, float]:
    """Anywhere on a lane, looking anywhere."""
    lane = site.lanes[int(rng.integers(len(site.lanes)))]
    k, t = int(rng.integers(len(lane.points) - 1)), rng.random()
    (x0, y0), (x1, y1) = lane.points[k], lane.points[k + 1]
    return float(x0 + t * (x1 - x0)), float(y0 + t * (y1 - y0)), float(rng.uniform(-math.pi, math.pi))


def _camera(rear: bool, rng: np.random.Generator) -> PinholeCamera:
    """The robot's camera, mounted a little differently each time."""
    camera = robot_camera(rear=rear)
    return replace(
        camera, z=camera.z + float(rng.uniform(-0.08, 0.08)), pitch=camera.pitch + float(rng.normal(0.0, 0.02))
    )


def _exposed(light: LightParams, rng: np.random.Generator) -> LightParams:
    """The same sky, another answer of the camera."""
    return replace(
        light, exposure=light.exposure * float(np.exp(rng.normal(0.0, 0.3))),
        red_gain=float(np.exp(rng.normal(0.0, 0.07))), blue_gain=float(np.exp(rng.normal(0.0, 0.07))),
        noise=light.noise * float(np.exp(rng.uniform(-0.7, 1.0))), blur_px=float(rng.uniform(0.3, 1.1)),
    )  # fmt: skip
