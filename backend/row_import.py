"""The process that finds rows: `python -m backend.row_import MAP NAME ...`, one JSON object a line on stdout.

It runs by itself, with limits on memory and processor, because a 3D map comes from anywhere and takes a minute.
"""

from __future__ import annotations

import argparse
import json
from dataclasses import replace
from pathlib import Path

from backend.confinement import WAITED_FOR, leave_network, limit_resources
from backend.orthophoto_import import say, tell
from navcore.errors import InputError
from navcore.mapping.row_map.cloud_in_map import read_seen_cloud
from navcore.mapping.row_map.map_rows import map_rows
from navcore.mapping.row_map.row_map import RowMap
from navcore.maps.site_map import Datum
from navcore.promptness import give_way
from navcore.transport.codec import encode

_STEPS = ("Finding the ground", "Looking for posts", "Finding rows and headlands")
TOO_LARGE = "This map needs too much memory. Thin it out to a point every 5 cm, or cut it to one block."


def main() -> int:
    """Find the rows of one map. Exit status 0 whenever the last line says how it went."""
    arguments = _arguments()
    limit_resources(arguments.memory_bytes, arguments.cpu_s)
    give_way(WAITED_FOR)
    leave_network()
    try:
        found = find_rows(arguments.map, arguments.name, Datum(
            lat_deg=arguments.lat_deg, lon_deg=arguments.lon_deg, height_m=arguments.height_m
        ))  # fmt: skip
    except InputError as error:
        say({"error": str(error).replace(str(arguments.map), arguments.name)})
    except MemoryError:
        say({"error": TOO_LARGE})
    else:
        say({"done": json.loads(encode(found))})
    return 0


def find_rows(path: Path, name: str, datum: Datum) -> RowMap:
    """What a map shows, in the frame of `datum`. Raises CloudError."""
    tell(0.0, "Reading the map")
    cloud, placed = read_seen_cloud(path, datum, name)
    found, _ = map_rows([cloud], tell=_tell_step)
    return replace(found, notes=(*found.notes, placed))


def _tell_step(step: str) -> None:
    tell((1 + _STEPS.index(step)) / (1 + len(_STEPS)) if step in _STEPS else 0.5, step)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="backend.row_import")
    parser.add_argument("map", type=Path)
    parser.add_argument("name")
    for name in ("--lat-deg", "--lon-deg", "--height-m"):
        parser.add_argument(name, type=float, required=True)
    for name in ("--memory-bytes", "--cpu-s"):
        parser.add_argument(name, type=int, required=True)
    return parser.parse_args()


if __name__ == "__main__":
    raise SystemExit(main())
