"""From the log of a run to the trunks that it saw. `trunks_of_views` is the same for views that are at hand."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from pathlib import Path

from navcore.mapping.merged_runs import all_passes
from navcore.mapping.passes import passes
from navcore.mapping.plant_tracks import PlantTracks, PlantTracksParams
from navcore.mapping.pose_track import PoseTrack
from navcore.maps.site_map import Row
from navcore.maps.trunk_map import TrunkMap, trunks_of_row
from navcore.messages import CameraView, NavStatus, PoseEstimate
from navcore.recording.reader import read_log, read_metadata
from navcore.topics import CAMERA_VIEW, NAV_STATUS
from navcore.transport.codec import decode


def trunks_seen(log: Path, rows: Sequence[Row], params: PlantTracksParams = PlantTracksParams()) -> TrunkMap:
    """Trunks and posts on the lines of `rows` that a run saw; none for a robot without a 2D LiDAR.

    Their ids begin with the run's, so that no two runs name different trunks alike. Raises LogError if `log` is no
    run log, InputError if a message in it is of another version.
    """
    run_id = read_metadata(log).get("run_id") or log.stem
    views: list[CameraView] = []
    poses: list[PoseEstimate] = []
    for message in read_log(log, (NAV_STATUS.name, CAMERA_VIEW.name)):
        if message.name == NAV_STATUS.name:
            pose = decode(NavStatus, message.payload).pose
            poses += [pose] if pose is not None else []
        elif (view := decode(CameraView, message.payload)).plants:
            # Only what is read of it: an hour's views would fill the memory.
            views.append(replace(view, objects=(), points=(), scan=(), ends=(), bearings=()))
    return trunks_of_views(views, poses, rows, run_id, params)


def trunks_of_views(
    views: Iterable[CameraView], poses: list[PoseEstimate], rows: Sequence[Row], run_id: str,
    params: PlantTracksParams = PlantTracksParams(),
) -> TrunkMap:  # fmt: skip
    """Trunks that the views of a run show, the robot having been at `poses`; each once, however often passed."""
    tracks = PlantTracks(PoseTrack(poses), params)
    for view in views:
        tracks.add(view)
    found = all_passes(passes(tracks.good(), tracks.stds))
    trunks = tuple(replace(trunk, id=f"{run_id}-{k}") for k, trunk in enumerate(found, start=1))
    return on_rows(TrunkMap(trunks=trunks), rows)


def on_rows(trunk_map: TrunkMap, rows: Sequence[Row]) -> TrunkMap:
    """Only those that stand on the line of a row."""
    kept = {placed.trunk.id for row in rows for placed in trunks_of_row(trunk_map, row)}
    return TrunkMap(trunks=tuple(trunk for trunk in trunk_map.trunks if trunk.id in kept))
