"""The process that draws a 3D map from above: `python -m backend.map3d_drawing FOLDER ...`, for a map's folder.

It leaves `above.png`, the ground's heights and, last of all, `above.json`. A process of its own, because a cloud
keeps Python busy for seconds and the live feed must go on. Says in one sentence on stdout what is wrong with a map,
with exit status 3.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from backend.confinement import WAITED_FOR, leave_network, limit_resources
from backend.exit_status import UNREADABLE
from backend.height_colours import height_colours
from backend.map3d_files import CLOUD, FACTS, GROUND, NDT, PICTURE
from backend.map3d_ground import ground_bytes
from backend.png import encode_png
from navcore.disk import write_durably
from navcore.errors import InputError, NdtMapError
from navcore.mapping.surface_model import SurfaceModel, surface_model
from navcore.mapping.trellis.ground_model import GroundModel
from navcore.maps.cloud_files.cloud_file import read_cloud
from navcore.maps.ndt.ndt_file import ndt_datum_of
from navcore.promptness import give_way

# What lies lower is ground, m: it lets the orthophoto through.
LOW = 0.2
GROUND_ALPHA, ALPHA = 90, 235
NO_PLACE = "map.ndt does not say where it lies on the Earth."
TOO_LARGE = "it needs too much memory to be drawn."


def main() -> int:
    """Draw one map, whole or not at all."""
    arguments = _arguments()
    limit_resources(arguments.memory_bytes, arguments.cpu_s)
    give_way(WAITED_FOR)
    leave_network()
    os.chdir(arguments.folder)  # so that no sentence names the station's folders
    try:
        draw()
    except InputError as error:
        sys.stdout.write(str(error))
    except OSError as error:
        sys.stdout.write(f"{error.filename or 'a file'} cannot be read or written: {error.strerror}.")
    except MemoryError:
        sys.stdout.write(TOO_LARGE)
    else:
        return 0
    return UNREADABLE


def draw() -> None:
    """The map of this folder. Raises CloudError and NdtMapError."""
    datum = ndt_datum_of(Path(NDT).read_bytes(), NDT)
    if datum is None:
        raise NdtMapError(NO_PLACE)
    points = read_cloud(Path(CLOUD)).cloud.points
    ground = GroundModel.of([points])
    surface = surface_model(points, ground, datum)
    height_px, width_px = surface.heights.shape
    facts = {"bounds_3857": surface.bounds, "pixel": surface.pixel, "width_px": width_px, "height_px": height_px}
    Path(FACTS).unlink(missing_ok=True)
    write_durably(Path(PICTURE), encode_png(coloured(surface)))
    write_durably(Path(GROUND), ground_bytes(ground))
    write_durably(Path(FACTS), json.dumps(facts, allow_nan=False).encode())


def coloured(surface: SurfaceModel) -> NDArray[np.uint8]:
    """(rows, columns, 4): see-through where nothing was seen, half so on the ground."""
    heights = surface.heights
    seen = np.isfinite(heights)
    rgba = np.zeros((*heights.shape, 4), np.uint8)
    rgba[seen, :3] = height_colours(heights[seen])
    rgba[seen, 3] = np.where(heights[seen] < LOW, GROUND_ALPHA, ALPHA)
    return rgba


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="backend.map3d_drawing")
    parser.add_argument("folder", type=Path)
    for name in ("--memory-bytes", "--cpu-s"):
        parser.add_argument(name, type=int, required=True)
    return parser.parse_args()


if __name__ == "__main__":
    raise SystemExit(main())
