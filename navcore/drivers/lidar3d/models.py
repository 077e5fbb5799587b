"""What differs between the LiDARs whose packets share one layout: beams, units and timing."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

CHANNELS = 16
FIRINGS = 2  # of all channels, in one block


class ModelName(StrEnum):
    """As settings and commands name them."""

    VLP16 = "vlp16"
    C16 = "c16"
    C16_FINE = "c16-fine"


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarModel:
    """One kind of LiDAR.

    Attributes:
        name, title: for settings, and for people.
        vertical_deg: elevation of each channel, in the order of firing.
        height_mm: by how much each channel's ray crosses the axis above the sensor's origin.
        unit: of a told distance, m. nearest, farthest: what it can measure, m.
        firing_us, channel_us: from one firing of all channels to the next, and from channel to channel.
        stamped_at_end: a packet tells when its last point was taken, else when its first was.
        counter_us: the packets' microseconds start anew after so many.
        lever, lever_deg: rays leave the head so far from its axis, m, in that direction from the ray.
    """

    name: ModelName
    title: str
    vertical_deg: tuple[float, ...]
    height_mm: tuple[float, ...] = (0.0,) * CHANNELS
    unit: float
    nearest: float
    farthest: float
    firing_us: float
    channel_us: float
    stamped_at_end: bool
    counter_us: int
    lever: float = 0.0
    lever_deg: float = 0.0

    @property
    def block_us(self) -> float:
        """From one block of a packet to the next."""
        return FIRINGS * self.firing_us

    def rings(self) -> NDArray[np.uint8]:
        """(16,) of each channel: its place counted from the lowest."""
        return np.argsort(np.argsort(self.vertical_deg)).astype(np.uint8)


# VLP-16 user manual 63-9243: tables 9-1 (beams and their vertical correction) and 9.4 (timing).
VLP16 = LidarModel(
    name=ModelName.VLP16, title="Velodyne VLP-16",
    vertical_deg=(-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15),
    height_mm=(11.2, -0.7, 9.7, -2.2, 8.1, -3.7, 6.6, -5.1, 5.1, -6.6, 3.7, -8.1, 2.2, -9.7, 0.7, -11.2),
    unit=0.002, nearest=0.0, farthest=131.07, firing_us=55.296, channel_us=2.304, stamped_at_end=False,
    counter_us=3_600_000_000,
)  # fmt: skip


def _c16(name: ModelName, title: str, vertical_deg: tuple[float, ...]) -> LidarModel:
    """Leishen's public drivers (lslidar_driver): unit, timing, lever of the rays and when a packet is stamped."""
    return LidarModel(
        name=name, title=title, vertical_deg=vertical_deg, unit=0.0025, nearest=0.2, farthest=163.8375,
        firing_us=50.0, channel_us=3.125, stamped_at_end=True, counter_us=1_000_000, lever=0.04319, lever_deg=14.67,
    )  # fmt: skip


C16 = _c16(ModelName.C16, "Leishen C16 (2 deg)", (-15, 1, -13, 3, -11, 5, -9, 7, -7, 9, -5, 11, -3, 13, -1, 15))
C16_FINE = _c16(
    ModelName.C16_FINE, "Leishen C16 (1.33 deg)",
    (-10, 0.665, -8.665, 2, -7.33, 3.33, -6, 4.665, -4.665, 6, -3.33, 7.33, -2, 8.665, -0.665, 10),
)  # fmt: skip

MODELS = {model.name: model for model in (VLP16, C16, C16_FINE)}
