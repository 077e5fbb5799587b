"""A folder of pictures of a board, and of the scans taken with them."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from navcore.calibration.board import BoardSighting, Image
from navcore.calibration.board_finder import BoardFinder
from navcore.calibration.board_run import PlainScan, plain_scan
from navcore.calibration.extrinsics import BoardPair
from navcore.errors import CalibrationError, InputError

PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff")
HEADER = ["angle_deg", "distance_m"]
# Rays in a file: a minute of a fast sensor.
MOST_RAYS = 2_000_000


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SeenFolder:
    """What the folder gave.

    Attributes:
        sightings: boards found, by file name. refused: file name and reason of every other picture.
    """

    sightings: tuple[BoardSighting, ...]
    refused: tuple[tuple[str, str], ...]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PairedFolder:
    """As `SeenFolder`, of pictures with their scans."""

    pairs: tuple[BoardPair, ...]
    refused: tuple[tuple[str, str], ...]


def see_folder(folder: Path, finder: BoardFinder) -> SeenFolder:
    """Boards in all pictures of a folder. Raises CalibrationError if there is no picture at all."""
    sightings, refused = list[BoardSighting](), list[tuple[str, str]]()
    for path in pictures(folder):
        image = read_picture(path)
        found = "The file is damaged, or no picture." if image is None else finder.find(image, path.name)
        if isinstance(found, str):
            refused.append((path.name, found))
        else:
            sightings.append(found)
    return SeenFolder(sightings=tuple(sightings), refused=tuple(refused))


def pair_folder(folder: Path, finder: BoardFinder) -> PairedFolder:
    """Pictures that show the board, each with the scan of its name. What has no partner is among the refused."""
    seen = see_folder(folder, finder)
    pairs, refused = list[BoardPair](), list(seen.refused)
    for sighting in seen.sightings:
        scan = folder / f"{Path(sighting.name).stem}.csv"
        try:
            pairs.append(BoardPair(sighting=sighting, scan=read_scan(scan)))
        except InputError as error:
            refused.append((sighting.name, str(error)))
    stems = {path.stem for path in pictures(folder)}
    lonely = [path.name for path in sorted(folder.glob("*.csv")) if path.stem not in stems]
    return PairedFolder(pairs=tuple(pairs), refused=(*refused, *((name, "It has no picture.") for name in lonely)))


def pictures(folder: Path) -> list[Path]:
    """Its pictures by name. Raises CalibrationError if there is none, or no folder."""
    if not folder.is_dir():
        raise CalibrationError((f"There is no folder {folder}.",))
    found = sorted(path for path in folder.iterdir() if path.suffix.lower() in PICTURES)
    if not found:
        raise CalibrationError((f"There is no picture ({', '.join(PICTURES)}) in {folder}.",))
    return found


def read_picture(path: Path) -> Image | None:
    """(H, W) grey as the sensor saw it, whatever way up a viewer would turn it; None if it cannot be read."""
    image = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE | cv2.IMREAD_IGNORE_ORIENTATION)
    return None if image is None else np.asarray(image, dtype=np.uint8)


def read_scan(path: Path) -> PlainScan:
    """Rows `angle_deg,distance_m` under that heading, several turns one after the other where the board was held.

    Raises CalibrationError, NotFiniteError.
    """
    if not path.is_file():
        raise CalibrationError((f"There is no {path.name} with its scan.",))
    try:
        with path.open(newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        if not rows or [cell.strip() for cell in rows[0]] != HEADER:
            raise CalibrationError((f"{path.name} does not begin with the line {','.join(HEADER)}.",))
        if len(rows) > MOST_RAYS:
            raise CalibrationError((f"{path.name} has more than {MOST_RAYS} rays; take one second.",))
        rays = np.array([[float(cell) for cell in row] for row in rows[1:] if row], dtype=np.float64)
    except (OSError, ValueError, csv.Error) as error:
        raise CalibrationError((f"{path.name} cannot be read as rays: {error}.",)) from error
    if rays.ndim != 2 or rays.shape[1] != 2:
        raise CalibrationError((f"{path.name} must have two numbers in every row.",))
    return plain_scan(rays[:, 0] * math.pi / 180.0, rays[:, 1])
