"""How the cameras are mounted, by all that the rows have told lately."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterable

from navcore.messages import CameraMount, CameraName, RowObservation

# Readings of four metres each that count, and without so many nothing is told.
LATELY, LEAST = 6, 3


class CameraTruth:
    """Means of the newest readings of each camera; `newest` is of the one that told last."""

    def __init__(self) -> None:
        self._readings: dict[CameraName, deque[CameraMount]] = {}
        self.newest: CameraMount | None = None

    def take(self, row: RowObservation) -> None:
        """One observation: most of them tell nothing."""
        if row.mount is None:
            return
        readings = self._readings.setdefault(row.camera, deque(maxlen=LATELY))
        readings.append(row.mount)
        if len(readings) >= LEAST:
            self.newest = mean_mount(readings)


def mean_mount(readings: Iterable[CameraMount]) -> CameraMount:
    """Readings weighed by what they are worth. The height grows no surer: wheels slip always to the same side."""
    told = list(readings)
    by_pitch, by_height = ([1.0 / std**2 for std in stds] for stds in _stds(told))
    pitch = sum(w * m.pitch for w, m in zip(by_pitch, told, strict=True)) / sum(by_pitch)
    height = sum(w * m.height for w, m in zip(by_height, told, strict=True)) / sum(by_height)
    return CameraMount(
        pitch=pitch, pitch_std=1.0 / math.sqrt(sum(by_pitch)), height=height,
        height_std=min(m.height_std for m in told), told_height=told[-1].told_height,
    )  # fmt: skip


def _stds(told: list[CameraMount]) -> tuple[list[float], list[float]]:
    return [m.pitch_std for m in told], [m.height_std for m in told]
