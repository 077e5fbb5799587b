"""From the log of a run to the trunks that it saw. `trunks_of_views` is the same for views that are at hand."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from pathlib import Path

from navcore.mapping.one_trunk import all_passes
from navcore.mapping.passes import SeenPlant, passes
from navcore.mapping.plant_tracks import PlantTracks, PlantTracksParams
from navcore.mapping.pose_track import PoseTrack
from navcore.maps.site_map import Row
from navcore.maps.trunk_map import MappedTrunk, TrunkMap, trunks_of_row
from navcore.messages import CameraView, NavStatus, PoseEstimate
from navcore.recording.reader import read_metadata, read_typed
from navcore.topics import CAMERA_VIEW, NAV_STATUS


def trunks_seen(log: Path, rows: Sequence[Row], params: PlantTracksParams = PlantTracksParams()) -> TrunkMap:
    """Trunks and posts on the lines of `rows` that a run saw; none for a robot without a 2D LiDAR.

    Their ids begin with the run's, so that no two runs name different trunks alike. Raises LogError if `log` is no
    run log, InputError if a message in it is of another version.
    """
    run_id = read_metadata(log).get("run_id") or log.stem
    poses = [s.pose for s in read_typed(log, NAV_STATUS.name, NavStatus) if s.pose is not None]
    return trunks_of_views(read_typed(log, CAMERA_VIEW.name, CameraView), poses, rows, run_id, params)


def trunks_of_views(
    views: Iterable[CameraView], poses: list[PoseEstimate], rows: Sequence[Row], run_id: str,
    params: PlantTracksParams = PlantTracksParams(),
) -> TrunkMap:  # fmt: skip
    """Trunks that the views of a run show, the robot having been at `poses`; each once, however often passed."""
    tracks = PlantTracks(PoseTrack(poses), params)
    for view in views:
        tracks.add(view)
    plants = all_passes(passes(tracks.good(), tracks.stds))
    trunks = tuple(_mapped(run_id, k, plant) for k, plant in enumerate(plants, start=1))
    return on_rows(TrunkMap(trunks=trunks), rows)


def on_rows(trunk_map: TrunkMap, rows: Sequence[Row]) -> TrunkMap:
    """Only those that stand on the line of a row."""
    kept = {placed.trunk.id for row in rows for placed in trunks_of_row(trunk_map, row)}
    return TrunkMap(trunks=tuple(trunk for trunk in trunk_map.trunks if trunk.id in kept))


def _mapped(run_id: str, number: int, plant: SeenPlant) -> MappedTrunk:
    return MappedTrunk(
        id=f"{run_id}-{number}", x=plant.x, y=plant.y, std=plant.std, diameter=plant.diameter,
        sureness=min(1.0, max(0.0, plant.sureness)) if math.isfinite(plant.sureness) else 0.0,
    )  # fmt: skip
