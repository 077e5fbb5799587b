"""The import process: `python -m backend.orthophoto_import SOURCE TARGET ...`, one JSON object a line on stdout.

It runs by itself, with limits on memory, processor and file size, because a GeoTIFF comes from anywhere and GDAL is
large.
"""

from __future__ import annotations

import argparse
import json
import sys
from dataclasses import asdict
from pathlib import Path

from rasterio._err import CPLE_BaseError
from rasterio.errors import RasterioError

from backend.confinement import leave_network, limit_resources
from backend.gdal_setup import gdal, open_geotiff
from backend.orthophoto_check import CheckParams, PictureFacts, check_bands, check_size, locate
from backend.orthophoto_copy import Tell, build_overviews, copy
from navcore.errors import OrthophotoError
from navcore.promptness import stand_back

DAMAGED = (RasterioError, CPLE_BaseError, UnicodeDecodeError)  # what GDAL raises of a file that contradicts itself
NOT_READABLE = "This file cannot be read as a GeoTIFF. Export the orthophoto again as a GeoTIFF, not as a photo."
BROKEN = "This GeoTIFF is damaged: its pixels cannot be read to the end. Copy or export it again."


def main() -> int:
    """Import one picture. Exit status 0 whenever the last line says how it went."""
    arguments = _arguments()
    limit_resources(arguments.memory_bytes, arguments.cpu_s)
    stand_back()
    leave_network()
    try:
        facts = import_picture(
            arguments.source, arguments.target, CheckParams(decoded_bytes=arguments.decoded_bytes), tell
        )
    except OrthophotoError as error:
        say({"error": str(error)})
    except MemoryError:
        say({"error": "This picture needs too much memory. Export it tiled, with 8 bits per colour."})
    else:
        say({"done": asdict(facts)})
    return 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="backend.orthophoto_import")
    parser.add_argument("source", type=Path)
    parser.add_argument("target", type=Path)
    for name in ("--decoded-bytes", "--memory-bytes", "--cpu-s"):
        parser.add_argument(name, type=int, required=True)
    return parser.parse_args()


def say(line: dict[str, object]) -> None:
    """To the station."""
    sys.stdout.write(json.dumps(line) + "\n")
    sys.stdout.flush()


def tell(progress: float, message: str) -> None:
    """How far it is."""
    say({"progress": round(progress, 3), "message": message})


def import_picture(source: Path, target: Path, params: CheckParams, tell: Tell) -> PictureFacts:
    """Check and copy. Raises OrthophotoError; then `target` is no picture and must be deleted."""
    with gdal():
        tell(0.0, "Checking the file")
        try:
            picture = open_geotiff(source)
        except DAMAGED as error:
            raise OrthophotoError(NOT_READABLE) from error
        with picture:
            try:
                check_size(picture, source.stat().st_size, params)
                bands = check_bands(picture)
                facts = locate(picture, params)
                copy(picture, bands, target, tell)
                build_overviews(target, tell)
            except DAMAGED as error:
                raise OrthophotoError(BROKEN) from error
    return facts


if __name__ == "__main__":
    raise SystemExit(main())
