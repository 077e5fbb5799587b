"""A keyframe: what was seen about one place of the drive, and how it was reached; small enough to keep thousands."""

from __future__ import annotations

import io
import zipfile
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.errors import InputError
from navcore.geometry.se3 import SE3

Floats = NDArray[np.float64]
Singles = NDArray[np.float32]
Bytes = NDArray[np.uint8]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PlacedFix:
    """A GNSS position on the way to a keyframe.

    Attributes:
        antenna: (3,) where the antenna was, in the keyframe, m. place: (3,) east, north, up of the datum, m.
        std: (3,) 1-sigma, m. quality: of GGA.
    """

    antenna: Floats
    place: Floats
    std: Floats
    quality: int


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Keyframe:
    """One of a drive's.

    Attributes:
        stamp_ns: of its last turn. driven: since the first keyframe, m.
        T_odom_base: as the scans were laid one on the other.
        covariance: (6, 6) of the pose against the keyframes before it: translation, m, and rotation vector, rad,
            along the axes of `odom`.
        up: (3,) unit vector against gravity, in `base_link`.
        points: (N, 3) of all turns since the keyframe before, thinned, in `base_link`, m. intensities: (N,).
        fix: the best one on the way here, if there was any.
        scans, lost: turns since the keyframe before, and those among them that the map did not hold.
        score: mean of the turns' matches, 0 to 1.
    """

    stamp_ns: int
    driven: float
    T_odom_base: SE3
    covariance: Floats
    up: Floats
    points: Singles
    intensities: Bytes
    fix: PlacedFix | None
    scans: int
    lost: int
    score: float


def keyframe_bytes(k: Keyframe) -> bytes:
    """As a file: an uncompressed .npz whose parts carry checksums."""
    fix = np.zeros(10)
    if k.fix is not None:
        fix[:] = (*k.fix.antenna, *k.fix.place, *k.fix.std, k.fix.quality)
    written = io.BytesIO()
    np.savez(
        written, stamp_ns=np.int64(k.stamp_ns), pose=np.column_stack((k.T_odom_base.R, k.T_odom_base.t)),
        covariance=k.covariance, up=k.up, points=k.points, intensities=k.intensities, fix=fix,
        numbers=np.array((k.driven, k.scans, k.lost, k.score)),
    )  # fmt: skip
    return written.getvalue()


def read_keyframe(data: bytes) -> Keyframe:
    """Raises InputError for a file that is cut off or changed."""
    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as parts:
            driven, scans, lost, score = parts["numbers"].tolist()
            pose, fix = parts["pose"], parts["fix"]
            T_odom_base = SE3(pose[:, :3].copy(), pose[:, 3].copy())
            return Keyframe(
                stamp_ns=int(parts["stamp_ns"]), driven=driven, T_odom_base=T_odom_base,
                covariance=parts["covariance"], up=parts["up"], points=parts["points"],
                intensities=parts["intensities"], fix=_fix(fix), scans=int(scans), lost=int(lost), score=score,
            )  # fmt: skip
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile) as error:
        raise InputError(f"A keyframe cannot be read ({error}); it is made again from the drive.") from error


def _fix(numbers: Floats) -> PlacedFix | None:
    if not numbers.any():
        return None
    return PlacedFix(antenna=numbers[:3], place=numbers[3:6], std=numbers[6:9], quality=int(numbers[9]))
