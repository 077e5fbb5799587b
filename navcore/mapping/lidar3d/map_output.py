"""The files of a map: NDT map, cloud, and what it is good for."""

from __future__ import annotations

import json
from dataclasses import asdict
from pathlib import Path

from navcore.errors import InputError
from navcore.mapping.lidar3d.map_maker import MadeMap
from navcore.maps.cloud_files.cloud_file import write_cloud
from navcore.maps.ndt.ndt_file import write_ndt_map

NDT_FILE, REPORT_FILE = "map.ndt", "report.json"
CLOUD_FILES = ("cloud.laz", "cloud.pcd")


def write_map(folder: Path, made: MadeMap) -> list[Path]:
    """Write `map.ndt`, `cloud.laz`, `cloud.pcd` and, last of all, `report.json`. Raises InputError."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"The folder {folder} cannot be made: {error.strerror}.") from error
    paths = [folder / NDT_FILE, *(folder / name for name in CLOUD_FILES), folder / REPORT_FILE]
    write_ndt_map(paths[0], made.ndt)
    for path in paths[1:-1]:
        write_cloud(path, made.cloud)
    try:
        paths[-1].write_text(json.dumps(asdict(made.report), indent=1, allow_nan=False))
    except OSError as error:
        raise InputError(f"{paths[-1]} cannot be written: {error.strerror}.") from error
    return paths
