"""Recorded detections: drives through a row as a faulty detector would have seen them, with the truth beside.

They set the difficulty on which the published row fits are compared, once, before anything is tuned. No picture is
rendered: boxes are projected from the plants and then spoilt.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from navcore.geometry.line2 import Line2
from navcore.geometry.pinhole import PinholeCamera
from navcore.geometry.se2 import SE2
from navcore.messages import DetectedObject, ObjectKind
from navcore.perception.image_lines import image_line

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedRowsParams:
    """The row, the drive, and the detector's faults. Pixels count at 640 px image width.

    The defaults are the difficulty, set once (seed 1) so that least squares, RANSAC and temporal RANSAC land near the
    published 80 / 92 / 97 % of valid frames. Many objects and a few feet hidden by up to half the trunk are what it
    takes: with few objects the rule itself fails, and with none hidden least squares is as good as RANSAC.

    Attributes:
        frames: pictures of one drive, 0.1 s apart.
        speed: m/s.
        width, spacing, length: of the corridor and between plants, and of the row ahead of the start, m.
        neighbours: lines of plants beyond each side.
        sway, sway_heading_deg: amplitude of the robot's lateral and angular swing.
        pitch_deg: 1-sigma of the camera's pitch on rough ground.
        scatter: 1-sigma of the plants about their line, m.
        reach: objects further away are not found, m.
        drop_out: share of the objects that are not found; `burst` is the share of pictures in which one whole side
            is hidden, and `burst_frames` for how long.
        false_boxes: mean number per picture.
        yaw_scale, yaw_step_deg: what the gyro tells for a turn of 1, and 1-sigma of it between two pictures;
            told_pitch_deg: 1-sigma of the pitch by the IMU. The simulated IMU is off by half: 0.02 and 0.11 deg;
            the published methods use neither.
        edge_px: 1-sigma of each box edge; `foot_lift` is the share of feet that grass hides, by up to `lift_px`.
    """

    frames: int = 200
    speed: float = 0.6
    width: float = 3.0
    spacing: float = 0.5
    length: float = 18.0
    neighbours: int = 2
    sway: float = 0.15
    sway_heading_deg: float = 2.0
    pitch_deg: float = 0.7
    scatter: float = 0.03
    reach: float = 12.0
    drop_out: float = 0.10
    burst: float = 0.007
    burst_frames: int = 8
    false_boxes: float = 0.02
    yaw_scale: float = 1.003
    yaw_step_deg: float = 0.04
    told_pitch_deg: float = 0.2
    edge_px: float = 0.6
    foot_lift: float = 0.08
    lift_px: float = 45.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordedFrame:
    """One picture's detections and its truth.

    Attributes:
        left, right: the plants' lines in the image.
        offset, heading: of the centre line in the driving frame.
        width: of the corridor, m. pitch: how much further down than mounted the camera looked, rad.
        to_end: distance ahead of the driving frame's origin to the last plant, m.
        told_pitch: the same as the IMU has it.
        motion: of the driving frame since the last picture, with odometry's error; None for the first.
    """

    objects: tuple[DetectedObject, ...]
    left: Line2
    right: Line2
    offset: float
    heading: float
    width: float
    pitch: float
    told_pitch: float
    to_end: float
    motion: SE2 | None


def record_rows(camera: PinholeCamera, params: RecordedRowsParams, rng: np.random.Generator) -> list[RecordedFrame]:
    """One drive along the x axis, front camera."""
    plants = _plants(params, rng)
    poses = [_pose(i * 0.1, params) for i in range(params.frames)]
    hidden = _hidden_sides(params, rng)
    told_off = np.radians(rng.spawn(1)[0].normal(0.0, params.told_pitch_deg, params.frames))
    frames = []
    for i, pose in enumerate(poses):
        pitch = math.radians(rng.normal(0.0, params.pitch_deg))
        tilted = replace(camera, pitch=camera.pitch + pitch)
        motion = _odometry(poses[i - 1].inverse() @ pose, params, rng) if i else None
        frame = _frame(tilted, pose, plants, hidden[i], motion, params, rng)
        frames.append(replace(frame, pitch=pitch, told_pitch=pitch + float(told_off[i])))
    return frames


def _pose(t: float, p: RecordedRowsParams) -> SE2:
    swing = 2 * math.pi * t / 9.0
    return SE2(p.speed * t, p.sway * math.sin(swing), math.radians(p.sway_heading_deg) * math.sin(swing + 1.3))


def _odometry(motion: SE2, p: RecordedRowsParams, rng: np.random.Generator) -> SE2:
    """By slipping wheels and the gyro."""
    yaw = motion.yaw * p.yaw_scale + math.radians(rng.normal(0.0, p.yaw_step_deg))
    return SE2(motion.x * 1.02, motion.y, yaw)


def _plants(p: RecordedRowsParams, rng: np.random.Generator) -> Floats:
    """Feet (N, 2); the rows begin well behind the start."""
    along = np.arange(-p.spacing * 6, p.length, p.spacing)
    sides = (np.arange(-p.neighbours - 1, p.neighbours + 1) + 0.5) * p.width
    grid = np.stack(np.meshgrid(along, sides), axis=-1).reshape(-1, 2)
    return np.asarray(grid + rng.normal(0.0, p.scatter, grid.shape))


def _hidden_sides(p: RecordedRowsParams, rng: np.random.Generator) -> NDArray[np.int64]:
    """Per picture the side that cannot be seen: +1 left, -1 right, 0 none."""
    hidden = np.zeros(p.frames, dtype=np.int64)
    for start in np.flatnonzero(rng.random(p.frames) < p.burst):
        hidden[start : start + p.burst_frames] = rng.choice((-1, 1))
    return hidden


def _frame(
    camera: PinholeCamera, pose: SE2, plants: Floats, hidden: int, motion: SE2 | None, p: RecordedRowsParams,
    rng: np.random.Generator,
) -> RecordedFrame:  # fmt: skip
    visible = plants[plants[:, 1] * hidden <= 0] if hidden else plants
    seen = visible[rng.random(len(visible)) >= p.drop_out]
    objects = [*_boxes(camera, pose.inverse().apply(seen), p, rng), *_false_boxes(camera, p, rng)]
    heading = -pose.yaw
    offset = -pose.y
    left, right = (image_line(camera, offset=offset + s * p.width / 2, heading=heading) for s in (1, -1))
    to_end = float(plants[:, 0].max()) - pose.x
    return RecordedFrame(
        objects=tuple(objects), left=left, right=right, offset=offset, heading=heading, width=p.width, pitch=0.0,
        told_pitch=0.0, to_end=to_end, motion=motion,
    )  # fmt: skip


def _boxes(
    camera: PinholeCamera, feet: Floats, p: RecordedRowsParams, rng: np.random.Generator
) -> list[DetectedObject]:
    """Spoilt boxes of trunks 8 cm thick and 1.2 m high, those that lie inside the picture."""
    ahead = feet[(feet[:, 0] > camera.x + 0.5) & (np.hypot(feet[:, 0] - camera.x, feet[:, 1]) < p.reach)]
    foot = camera.project(np.column_stack((ahead, np.zeros(len(ahead)))))
    top = camera.project(np.column_stack((ahead, np.full(len(ahead), 1.2))))
    half = 0.04 * camera.fx / (ahead[:, 0] - camera.x)
    edges = np.column_stack((foot[:, 0] - half, top[:, 1], foot[:, 0] + half, foot[:, 1]))
    scale = camera.width_px / 640
    edges += rng.normal(0.0, p.edge_px * scale, edges.shape)
    edges[:, 3] -= (rng.random(len(ahead)) < p.foot_lift) * rng.uniform(0.0, p.lift_px * scale, len(ahead))
    inside = (edges[:, 0] > 0) & (edges[:, 2] < camera.width_px) & (edges[:, 3] < camera.height_px)
    return [_box(e, 0.9) for e in edges[inside]]


def _false_boxes(camera: PinholeCamera, p: RecordedRowsParams, rng: np.random.Generator) -> list[DetectedObject]:
    count = int(rng.poisson(p.false_boxes))
    u = rng.uniform(0.05, 0.95, count) * camera.width_px
    v = rng.uniform(0.42, 0.98, count) * camera.height_px
    size = 0.02 * camera.width_px
    return [_box(np.array((a - size / 2, b - 5 * size, a + size / 2, b)), 0.5) for a, b in zip(u, v, strict=True)]


def _box(edges: Floats, confidence: float) -> DetectedObject:
    x1, y1, x2, y2 = (float(e) for e in edges)
    return DetectedObject(
        kind=ObjectKind.TRUNK, confidence=confidence, x1=min(x1, x2), y1=y1, x2=max(x1, x2) + 0.01, y2=max(y2, y1 + 1)
    )
