"""Which object of the picture is which scanned plant: by likelihood over both sensors' uncertainties. Ours.

Paper B takes what lies within one threshold of a ray, and meets the ray with the LiDAR's plane, where one pixel up or
down moves the meeting point by 15 cm at 3 m. Here the box tells the bearing, to a third of a degree, and how far away
its foot is, roughly; the scan tells both well. The assignment of all boxes to all plants at once is the likeliest.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from statistics import median

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.pinhole import PinholeCamera
from navcore.messages import DetectedObject
from navcore.perception.corridor_fit import foot_rays
from navcore.perception.plants.association_kernels import in_sight, lead
from navcore.perception.plants.scanned_plants import ScannedPlants

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True)
class BoxAssociationParams:
    """1-sigmas, and when an object has no plant. Ours; set on tuning farms.

    Attributes:
        box_px: of a box's middle, pixels at 640 px image width; foot_px: of its foot.
        mount_deg: of the bearing between the two sensors, deg.
        lean: by so much a trunk stands aside at the scan's height of where its foot is, m.
        pitch_deg: of the camera's pitch about what is told; range_share: of a foot's distance beside that.
        wider: logarithm of how much wider a box is than the plant's diameter: trunks sway and fork, and a scan misses
            the edges of thin ones far away. size: 1-sigma of it.
        reach: plants further away than that have no box, m.
        sureness: at most so much counts against a plant that is hardly a trunk, in the measure of `alone`.
        alone: half the squared distance beyond which an object has no plant.
        fewest: so many feet of plants tell the pitch; known_pitch: which is known to that share of `pitch_deg` then.
        clear: an object that another plant fits nearly as well, by less than that, is left without one.
        together: plants that stand no further apart than that are not asked which of them it is, m: a tree and the
            stake that it is tied to.
    """

    box_px: float = 1.5
    foot_px: float = 2.5
    mount_deg: float = 0.3
    lean: float = 0.03
    pitch_deg: float = 0.7
    range_share: float = 0.06
    wider: float = 0.65
    size: float = 0.35
    reach: float = 12.0
    sureness: float = 7.0
    alone: float = 7.0
    fewest: int = 4
    known_pitch: float = 0.4
    clear: float = 1.5
    together: float = 0.25


def associate(
    objects: tuple[DetectedObject, ...], plants: ScannedPlants, camera: PinholeCamera, pitch: float,
    params: BoxAssociationParams = BoxAssociationParams(),
) -> Ints:  # fmt: skip
    """(N,) index of the plant that each object is, -1 for none. `plants` are in the frame of `camera`'s mount, and
    `pitch` is by how much further down than its mount the camera looks, rad.
    """
    x, y = (plants.xy - (camera.x, camera.y)).T
    in_reach = np.flatnonzero((x >= 0.3) & (np.hypot(x, y) <= params.reach))
    if not objects or not len(in_reach):
        return np.full(len(objects), -1, dtype=np.int64)
    found = _in_reach(corners_of(objects), plants.only(in_reach), camera, pitch, params)
    return np.where(found < 0, -1, in_reach[found])


def boxed_as(found: Ints, plants: int) -> Ints:
    """(M,) index of the object that each of so many plants is, -1 for none, of what `associate` found."""
    objects = np.full(plants, -1, dtype=np.int64)
    which = np.flatnonzero(found >= 0)
    objects[found[which]] = which
    return objects


def _in_reach(
    boxes: Floats, plants: ScannedPlants, camera: PinholeCamera, pitch: float, p: BoxAssociationParams
) -> Ints:  # fmt: skip
    beside, down = _by_middle(boxes, plants, camera, pitch, p), _feet_down(boxes, camera)
    first = _assigned(beside + _by_foot(down, plants, camera, pitch, p.pitch_deg, p), plants.xy, p)
    told = _told_pitch(down, plants, first, camera, p)
    if told is None:
        return first
    return _assigned(beside + _by_foot(down, plants, camera, told, p.known_pitch * p.pitch_deg, p), plants.xy, p)


def _told_pitch(
    down: Floats, plants: ScannedPlants, found: Ints, camera: PinholeCamera, p: BoxAssociationParams
) -> float | None:
    """The pitch as the feet of `found` plants tell it, rad; None where too few do."""
    paired = np.flatnonzero((found >= 0) & np.isfinite(down))
    if len(paired) < p.fewest:
        return None
    ahead = plants.xy[found[paired], 0] - camera.x
    told: list[float] = (np.arctan(camera.z / ahead) - down[paired]).tolist()
    return median(told)


def _assigned(costs: Floats, xy: Floats, params: BoxAssociationParams) -> Ints:
    """(N,) index of the plant of each object by costs (N, M), -1 for none: the likeliest of all together."""
    # Half a second to import, which processes and robots without a LiDAR need not spend at their start.
    from scipy.optimize import linear_sum_assignment

    found = np.full(len(costs), -1, dtype=np.int64)
    alone = np.full((len(costs), len(costs)), params.alone)
    rows, columns = linear_sum_assignment(np.hstack((costs, alone)))
    taken = (columns < costs.shape[1]) & (lead(costs, xy, params.together)[rows] >= params.clear)
    found[rows[taken]] = columns[taken]
    return found


def _by_middle(
    boxes: Floats, plants: ScannedPlants, camera: PinholeCamera, pitch: float, p: BoxAssociationParams
) -> Floats:
    """(N, M) half the squared distances, in 1-sigmas, between the middles and widths of boxes (N, 4) and plants, and
    what counts against the plants.
    """
    ahead, y = (plants.xy - (camera.x, camera.y)).T
    scale = camera.width_px / 640 / camera.fx
    across = slopes(boxes, camera, pitch)[:, None] - (y / ahead)[None]
    across_std = np.sqrt(
        (p.box_px * scale) ** 2 + math.radians(p.mount_deg) ** 2 + (plants.std**2 + p.lean**2) / ahead**2
    )  # fmt: skip
    told_size = np.maximum(plants.diameter, 0.01) / ahead
    size = np.log(((boxes[:, 2] - boxes[:, 0]) / camera.fx)[:, None] / told_size[None])
    total = (across / across_std[None]) ** 2 + ((size - p.wider) / p.size) ** 2
    doubt = np.minimum(-np.log(np.maximum(plants.sureness, 1e-6)), p.sureness)
    return np.asarray(0.5 * total + doubt[None])


def _feet_down(boxes: Floats, camera: PinholeCamera) -> Floats:
    """(N,) how far below the camera's level mount the feet of boxes are seen, rad; NaN for a foot out of sight."""
    feet = np.column_stack(((boxes[:, 0] + boxes[:, 2]) / 2, boxes[:, 3]))
    seen = np.arctan(foot_rays(camera, feet)[:, 1])
    return np.asarray(np.where(boxes[:, 3] > camera.height_px - 1.0, np.nan, seen))


def _by_foot(
    down: Floats,
    plants: ScannedPlants,
    camera: PinholeCamera,
    pitch: float,
    pitch_deg: float,
    p: BoxAssociationParams,
) -> Floats:
    """(N, M) half the squared distances between where feet are seen and those of plants stand; 0 where not seen."""
    told = camera.z / (plants.xy[:, 0] - camera.x)
    scale = camera.width_px / 640 / camera.fx
    std = np.sqrt((p.foot_px * scale) ** 2 + math.radians(pitch_deg) ** 2 + (p.range_share * told) ** 2)
    off = (np.tan(down + pitch)[:, None] - told[None]) / std[None]
    return np.where(np.isnan(off), 0.0, 0.5 * off**2)


def corners_of(objects: tuple[DetectedObject, ...]) -> Floats:
    """(N, 4) x1, y1, x2, y2 of boxes, pixels."""
    return np.array([(o.x1, o.y1, o.x2, o.y2) for o in objects], dtype=np.float64).reshape(-1, 4)


def slopes(boxes: Floats, camera: PinholeCamera, pitch: float) -> Floats:
    """(N,) how far aside per metre ahead, + left, boxes' middles are of a camera that looks so much further down."""
    if not len(boxes):
        return np.empty(0)
    rays = foot_rays(camera, (boxes[:, :2] + boxes[:, 2:]) / 2)
    return np.asarray(rays[:, 0] / (math.cos(pitch) - rays[:, 1] * math.sin(pitch)), dtype=np.float64)


def should_be_seen(plants: ScannedPlants, camera: PinholeCamera, reach: float = 6.0) -> NDArray[np.bool_]:
    """(M,) which plants stand well inside the picture, with nothing nearer in line, no further than `reach` m."""
    x, y = plants.xy[:, 0] - camera.x, plants.xy[:, 1] - camera.y
    return np.asarray(in_sight(x, y, plants.diameter, (camera.fx, camera.cx), camera.width_px, reach))
