"""A corridor between two rows of trunks, seen by paper B's camera and LiDAR: boxes and scans with noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.lidar_mount import LidarMount
from navcore.geometry.pinhole import PinholeCamera
from navcore.geometry.se2 import SE2
from navcore.messages import DetectedObject, LidarScan, ObjectKind
from tests.navcore.perception.scan.scans import trunk_scan

Floats = NDArray[np.float64]

LIDAR = LidarMount(x=0.2, y=0.0, z=0.45)
# Paper B's intrinsics, and the camera's place in the LiDAR's frame.
CAMERA = PinholeCamera(
    width_px=1280, height_px=720, fx=639.3178, fy=635.1858, cx=660.2825, cy=363.30748,
    x=LIDAR.x + 0.075, y=LIDAR.y + 0.029, z=LIDAR.z - 0.096,
)  # fmt: skip
TRUNK_HEIGHT = 0.9


@dataclass(frozen=True, slots=True, kw_only=True)
class Corridor:
    """Trunks (N, 3), x, y and radius in the row's frame, whose centre line is its x axis; weeds likewise."""

    trunks: Floats
    weeds: Floats

    @staticmethod
    def planted(rng: np.random.Generator, *, scatter: float = 0.05, weeds: int = 0, width: float = 2.5) -> Corridor:
        """Two rows of 20 trunks 1.2 m apart, `scatter` m off their lines; weeds beside them that no box shows."""
        x = np.tile(np.arange(-3.0, 21.0, 1.2), 2)
        y = np.repeat((width / 2, -width / 2), len(x) // 2)
        trunks = np.column_stack((x + rng.normal(0, 0.1, len(x)), y + rng.normal(0, scatter, len(x)), 0 * x))
        trunks[:, 2] = rng.uniform(0.03, 0.07, len(x))
        beside = np.column_stack(
            (rng.uniform(-3, 20, weeds), rng.uniform(0.7, 1.9, weeds), rng.uniform(0.02, 0.1, weeds))
        )
        beside[:, 1] *= rng.choice((-1.0, 1.0), weeds)
        return Corridor(trunks=trunks, weeds=beside)

    def seen(self, pose: SE2, rng: np.random.Generator) -> tuple[list[DetectedObject], list[int], LidarScan]:
        """Boxes and the trunk of each, and the scan, from `base_link` at that pose in the row."""
        trunks = _from(self.trunks, pose)
        boxes = [(_box(trunk, rng), k) for k, trunk in enumerate(trunks) if 1.0 < trunk[0] < 9.0]
        shown = [(box, k) for box, k in boxes if box is not None]
        scan = trunk_scan(np.vstack((trunks, _from(self.weeds, pose))), LIDAR)
        noisy = tuple(float(d + rng.normal(0.0, 0.01)) if d else 0.0 for d in scan.distances)
        scan = LidarScan(stamp_ns=scan.stamp_ns, began_ns=scan.began_ns, angles=scan.angles, distances=noisy)
        return [box for box, _ in shown], [k for _, k in shown], scan


def _from(places: Floats, pose: SE2) -> Floats:
    return np.column_stack((pose.inverse().apply(places[:, :2]), places[:, 2]))


def _box(trunk: Floats, rng: np.random.Generator) -> DetectedObject | None:
    """The trunk's box with 2 px of noise, None out of the picture."""
    x, y, r = trunk
    corners = np.array([(x, y + r, 0.0), (x, y - r, 0.0), (x, y + r, TRUNK_HEIGHT), (x, y - r, TRUNK_HEIGHT)])
    u, v = CAMERA.project(corners).T
    if not (u.min() > 0.0 and u.max() < CAMERA.width_px):
        return None
    x1, x2, y1, y2 = np.array((u.min(), u.max(), max(v.min(), 0.0), min(v.max(), 720.0))) + rng.normal(0, 2, 4)
    confidence = float(rng.uniform(0.6, 0.95))
    return DetectedObject(
        kind=ObjectKind.TRUNK, confidence=confidence, x1=float(x1), y1=float(y1), x2=float(x2), y2=float(y2)
    )
