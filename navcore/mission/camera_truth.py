"""How the cameras are mounted, by all that the rows have told lately."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable

from navcore.messages import CameraMount, CameraName, MountAgreement, RowObservation

# Readings of four metres each that count, and without so many nothing is told.
LATELY, LEAST = 6, 3


class CameraTruth:
    """Means of the newest readings of each camera; `newest` is of the one that told last.

    `agreement` of a camera with the 2D LiDAR is the newest too, but one that has moved is not forgotten.
    """

    def __init__(self) -> None:
        self._readings: dict[CameraName, deque[CameraMount]] = {}
        self.newest: CameraMount | None = None
        self.agreement: MountAgreement | None = None

    def take(self, row: RowObservation) -> None:
        """One observation: most of them tell nothing."""
        if row.agreement is not None and not (self.agreement and self.agreement.moved):
            self.agreement = row.agreement
        if row.mount is None:
            return
        readings = self._readings.setdefault(row.camera, deque(maxlen=LATELY))
        readings.append(row.mount)
        if len(readings) >= LEAST:
            self.newest = mean_mount(readings)


def mean_mount(readings: Iterable[CameraMount]) -> CameraMount:
    """Readings weighed by what they are worth. The height grows no surer: wheels slip always to the same side."""
    told = list(readings)
    pitch, pitch_std = _mean([(m.pitch, m.pitch_std) for m in told])
    height, _ = _mean([(m.height, m.height_std) for m in told])
    return CameraMount(
        pitch=pitch, pitch_std=pitch_std, height=height, height_std=min(m.height_std for m in told),
        told_height=told[-1].told_height,
    )  # fmt: skip


def _mean(told: list[tuple[float, float]]) -> tuple[float, float]:
    """Of values with their 1-sigma, and its own."""
    information = sum(std**-2 for _, std in told)
    return sum(value * std**-2 for value, std in told) / information, information**-0.5
