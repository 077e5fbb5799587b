"""Recorded scans in files: rays, points in a plane, or a ring of a 3D LiDAR's turn."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError

Floats = NDArray[np.float64]
CAPTURES = (".pcap", ".pcapng")


class RecordedScan(NamedTuple):
    """One turn: bearings (N,) rad, rising, and distances (N,) m, all of rays that came back."""

    name: str
    angles: Floats
    distances: Floats


def scans_in(path: Path, elevation: float) -> Iterator[RecordedScan]:
    """All scans of a file, by its ending: CSV of rays, JSON of points by sensor, else 3D points or their packets, of
    which the ring at `elevation`, rad, is taken. Raises InputError that says what is wrong.
    """
    if not path.is_file():
        raise InputError(f"There is no file {path}.")
    ending = path.suffix.lower()
    if ending == ".csv":
        yield _rays(path)
    elif ending == ".json":
        yield from _sensors(path)
    else:
        yield from _rings(path, elevation, capture=ending in CAPTURES)


def _rays(path: Path) -> RecordedScan:
    from navcore.calibration.folder import read_scan

    scan = read_scan(path)
    return RecordedScan(path.name, scan.angles, scan.distances)


def _sensors(path: Path) -> Iterator[RecordedScan]:
    try:
        told = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise InputError(f"{path} cannot be read as JSON: {error}.") from error
    if not isinstance(told, dict) or not told:
        raise InputError(f'{path} must hold an object like {{"front": [[x, y], ...]}}, in metres.')
    for sensor, points in told.items():
        yield _of_points(f"{path.name} {sensor}", points)


def _of_points(name: str, points: Any) -> RecordedScan:
    try:
        xy = np.array(points, dtype=np.float64)
    except (ValueError, TypeError) as error:
        raise InputError(f"{name} must be a list of points [x, y] in metres.") from error
    if xy.ndim != 2 or xy.shape[1] != 2 or not len(xy):
        raise InputError(f"{name} must be a list of points [x, y] in metres.")
    if not np.isfinite(xy).all():
        raise InputError(f"{name} holds a point that is no number: leave out rays that did not come back.")
    return _sorted(name, np.mod(np.arctan2(xy[:, 1], xy[:, 0]), math.tau), np.hypot(xy[:, 0], xy[:, 1]))


def _rings(path: Path, elevation: float, *, capture: bool) -> Iterator[RecordedScan]:
    from navcore.perception.scan.cloud_ring import cloud_ring

    for number, points in enumerate(_clouds(path, capture=capture), start=1):
        bearings, distances = cloud_ring(points, elevation)
        if not len(bearings):
            raise InputError(f"{path} has no points {math.degrees(elevation):g} deg up: name another --elevation.")
        yield RecordedScan(f"{path.name} turn {number}" if capture else path.name, bearings, distances)


def _clouds(path: Path, *, capture: bool) -> Iterator[Floats]:
    from navcore.drivers.lidar3d.capture_turns import CaptureTurns
    from navcore.maps.cloud_files.cloud_file import read_cloud

    if capture:
        yield from (turn.cloud.points for turn in CaptureTurns(path).turns())
    else:
        file = read_cloud(path)
        if any(file.origin):
            raise InputError(f"{path} lies on a map's grid: a ring needs points as one LiDAR saw them, in its frame.")
        yield file.cloud.points


def _sorted(name: str, angles: Floats, distances: Floats) -> RecordedScan:
    order = np.argsort(angles, kind="stable")
    return RecordedScan(name, angles[order], distances[order])
