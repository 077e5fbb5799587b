"""The scans of the last seconds beside the pictures, and whether both sensors are in step."""

from __future__ import annotations

from collections import deque
from statistics import median

import numpy as np
from numpy.typing import NDArray

from navcore.calibration.board_run import PlainScan, plain_scan
from navcore.errors import InputError
from navcore.messages import LidarScan

Floats = NDArray[np.float64]
NS = 1_000_000_000
KEPT = 20  # two seconds of a LiDAR of 10 Hz
SILENT_NS = NS
LARGEST_STEP_S = 0.2
JUDGED = 8  # pictures that tell whether the sensors are in step


class ScanStore:
    """Scans as they come in."""

    def __init__(self) -> None:
        self._scans: deque[LidarScan] = deque(maxlen=KEPT)
        self._behind: deque[float] = deque(maxlen=JUDGED)

    def hear(self, scan: LidarScan) -> None:
        """The newest one."""
        self._scans.append(scan)

    def problem(self, picture_ns: int) -> str:
        """What is wrong with the scans beside a picture of that moment, a sentence; empty when all is well."""
        if not self._scans:
            return "The LiDAR gives no scans. Look at its cable and power."
        behind_s = (picture_ns - self._scans[-1].stamp_ns) / NS
        self._behind.append(behind_s)
        usual = median(self._behind)
        if len(self._behind) < JUDGED or abs(usual) <= LARGEST_STEP_S:
            return ""
        late, other = ("LiDAR's scans", "pictures") if usual > 0.0 else ("pictures", "LiDAR's scans")
        return (
            f"The {late} are {abs(usual):.1f} s older than the {other}: both must be in step within "
            f"{LARGEST_STEP_S:g} s. Look at the cable or network of what is late, and at its latency in the settings."
        )

    def newest(self) -> PlainScan | None:
        """The last turn; None where there is none, or nothing was hit."""
        return _plain([self._scans[-1]]) if self._scans else None

    def since(self, stamp_ns: int) -> PlainScan | None:
        """All rays of turns that began then or later, or of the last turn."""
        scans = [scan for scan in self._scans if scan.began_ns >= stamp_ns]
        return _plain(scans or list(self._scans)[-1:])


def _plain(scans: list[LidarScan]) -> PlainScan | None:
    if not scans:
        return None
    angles = np.concatenate([scan.angles for scan in scans])
    distances = np.concatenate([scan.distances for scan in scans])
    try:
        return plain_scan(angles, distances)
    except InputError:
        return None
