"""3D maps of a small block, as the station leaves them when it has made one of a run."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from backend.runs import NewRun
from backend.station import Station
from navcore.geometry.point_cloud import PointCloud
from navcore.mapping.lidar3d.map_output import CLOUD_FILES, NDT_FILE, REPORT_FILE
from navcore.maps.cloud_files.cloud_file import write_cloud
from navcore.maps.mission import Mission
from navcore.maps.ndt.ndt_file import write_ndt_map
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.maps.site_map import Datum, SiteMap
from navcore.messages import LinkLossPolicy, MissionPlan
from tests.navcore.mapping.standing_block import StandingBlock

BLOCK = StandingBlock(lines=3, posts=4)
REPORT = {
    "driven": 60.0, "keyframes": 70, "loops_taken": 5, "georeferenced": True, "rtk_share": 1.0, "fix_rms": 0.01,
    "loop_rms": 0.01, "hectares": 0.2, "points": 1000, "doubts": [],
}  # fmt: skip


@cache
def block_points() -> NDArray[np.float64]:
    """(N, 3) in `map`, m."""
    return BLOCK.seen(rays=False).points


def make_run(station: Station, site_id: str, site: SiteMap, mission: Mission, run_id: str) -> str:
    """A run of the site in the station's books."""
    stored = station.missions.create(site_id, mission)
    plan = MissionPlan(mission_id="", name=mission.name, datum=(0.0, 0.0, 0.0), segments=())
    station.runs.create(
        NewRun(
            id=run_id, site_id=site_id, mission_id=stored.id, site=site, mission=mission, plan=plan,
            link_loss=LinkLossPolicy.STOP,
        )
    )  # fmt: skip
    return run_id


def write_made_map(folder: Path, datum: Datum | None) -> None:
    """The files of a map of the block; without a datum it has no place on the Earth."""
    folder.mkdir(parents=True)
    ndt_map, points = NdtMap(datum=datum), block_points()
    ndt_map.add(points)
    write_ndt_map(folder / NDT_FILE, ndt_map)
    for name in CLOUD_FILES:
        write_cloud(folder / name, PointCloud.of(points))
    (folder / REPORT_FILE).write_text(json.dumps({**REPORT, "georeferenced": datum is not None}))


def cut(file: Path) -> None:
    """Half of it is lost."""
    data = file.read_bytes()
    file.write_bytes(data[: len(data) // 2])
