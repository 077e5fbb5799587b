"""Places of all plants of a pass at once: what stands beside each other in many views holds the views together.

Under the canopy the robot's place along the row drifts by decimetres. How the plants stand to each other is known to
millimetres, so the views of a pass are shifted until each plant stands in one place, and only the whole pass is
placed by the robot's poses: a linear least-squares problem (bundle adjustment of translations).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, csr_array, diags_array
from scipy.sparse.csgraph import connected_components
from scipy.sparse.linalg import spsolve

from navcore.mapping.met_again import met_again
from navcore.mapping.plant_tracks import PlantTrack
from navcore.mapping.pose_track import Std
from navcore.maps.trunk_map import MappedTrunk

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
# Of the normal distribution: sigma over the median of absolute deviations.
MAD_TO_SIGMA = 1.4826
# 1-sigma of a plant's place in a view, of a plant known best (bark, lean), and of a pose trusted most, m.
SIGHTING_STD = 0.03
LEAST_STD = 0.01
LEAST_POSE_STD = 0.02
# Errors of poses and trackers outlast a view: a pass counts so many of its sightings as independent.
INDEPENDENT = 4


def passes(tracks: list[PlantTrack], stds: list[Std]) -> list[tuple[MappedTrunk, ...]]:
    """The plants of each pass in the order driven, without ids. Those of one pass are linked by views that saw both.

    A plant that was forgotten and met again, as on the way back out, holds the two ways together once it is known
    to be one: so all is placed twice.
    """
    if not tracks:
        return []
    pose_std = np.maximum(np.asarray(stds), LEAST_POSE_STD)
    first = [plant for plant, _ in _all_placed(tracks, pose_std)]
    tracks = met_again(tracks, np.array([(p.x, p.y) for p in first]))
    plants = _all_placed(tracks, pose_std)
    linked = _linked(*_table(tracks)[:2], len(tracks), len(stds)).tolist()
    return [
        tuple(_anchored([p for p, c in zip(plants, linked, strict=True) if c == k])) for k in dict.fromkeys(linked)
    ]


def _all_placed(tracks: list[PlantTrack], pose_std: Floats) -> list[tuple[MappedTrunk, float]]:
    plant, view, xy = _table(tracks)
    shifts = np.column_stack([_shifts(plant, view, xy[:, i], pose_std[:, i]) for i in (0, 1)])
    moved = xy + shifts[view]
    return [_placed(track, moved[plant == k], pose_std[view[plant == k]]) for k, track in enumerate(tracks)]


def _table(tracks: list[PlantTrack]) -> tuple[Ints, Ints, Floats]:
    """Of all sightings: the plant (S,), the view (S,), and where (S, 2)."""
    table = np.asarray([(k, s.view, s.x, s.y) for k, track in enumerate(tracks) for s in track.sightings])
    return table[:, 0].astype(np.int64), table[:, 1].astype(np.int64), table[:, 2:]


def _shifts(plant: Ints, view: Ints, x: Floats, pose_std: Floats) -> Floats:
    """(V,) m by which each view is moved: minimises (x + shift - place)^2 / SIGHTING_STD^2 + shift^2 / pose_std^2.

    The places, each the mean of its sightings, are eliminated (Schur complement).
    """
    weight = SIGHTING_STD**-2
    ones = np.ones(len(x))
    A = csr_array(coo_array((ones, (view, plant)), shape=(len(pose_std), plant.max() + 1)))
    per_view, per_plant = np.bincount(view, minlength=len(pose_std)), np.bincount(plant)
    mean = np.bincount(plant, x) / per_plant
    H = diags_array(weight * per_view + pose_std**-2) - weight * (A @ diags_array(1.0 / per_plant) @ A.T)
    g = weight * np.bincount(view, mean[plant] - x, minlength=len(pose_std))
    return np.asarray(spsolve(csr_array(H).tocsc(), g))


def _linked(plant: Ints, view: Ints, plants: int, views: int) -> Ints:
    """(K,) number of each plant's pass."""
    n = plants + views
    graph = coo_array((np.ones(len(plant)), (plant, plants + view)), shape=(n, n))
    return np.asarray(connected_components(graph, directed=False)[1][:plants], dtype=np.int64)


def _placed(track: PlantTrack, xy: Floats, pose_std: Floats) -> tuple[MappedTrunk, float]:
    """The robust mean of a plant's sightings; beside it how well the pass is placed there, m."""
    middle = np.median(xy, axis=0)
    apart = np.abs(xy - middle)
    sigma = np.maximum(MAD_TO_SIGMA * np.median(apart, axis=0), LEAST_STD)
    x, y = xy[(apart <= 3.0 * sigma).all(axis=1)].mean(axis=0).tolist()
    own = float(np.sqrt(np.mean(sigma**2) / min(len(xy), INDEPENDENT)))
    diameter = float(np.median([s.diameter for s in track.sightings]))
    anchor = float(np.sqrt(np.mean(pose_std**2, axis=1)).min())
    return MappedTrunk(id="", x=x, y=y, std=own, diameter=diameter, sureness=track.sureness), anchor


def _anchored(plants: list[tuple[MappedTrunk, float]]) -> list[MappedTrunk]:
    """Each with the error of the pass's best pose in its sigma: the whole pass hangs on it."""
    best = min(anchor for _, anchor in plants)
    return [replace(p, std=float(np.hypot(max(p.std, LEAST_STD), best))) for p, _ in plants]
