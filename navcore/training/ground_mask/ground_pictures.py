"""Rendered pictures of young orchards with their corridor's ground: of tuning segments, and none that is driven."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from navcore.geometry.pinhole import robot_camera
from navcore.messages import SimTruth
from navcore.perception.published_fusion.ground_segmenter import SIDE_PX, squeezed
from navcore.sim.camera_light import LightName, LightParams, named_light
from navcore.sim.camera_renderer import CameraRenderer, RenderedFrame, RenderParams, Scene
from navcore.sim.corridor_ground import Corridor, segment_corridor
from navcore.sim.planting import build_orchard
from navcore.sim.young_orchard import LENGTH_M, Segment, YoungSegment, tuning_segment

Bytes = NDArray[np.uint8]
Mask = NDArray[np.bool_]

# The bench drives tuning segments from 0 on, so their trees stay unseen.
TRAINING, VALIDATION = 100, 200
_LIGHTS = (LightName.NOON, LightName.OVERCAST, LightName.EVENING, LightName.AFTERNOON, LightName.BACKLIT)


@dataclass(frozen=True, slots=True, kw_only=True)
class GroundPicturesParams:
    """How many, and from where: as a robot in the row has them.

    Attributes:
        plantings: of each of the five segments, each in a light of its own. shots: pictures of each.
        before: so far before the row's start pictures begin, m.
        left: to either side of the middle, m. turn_deg: from the row's direction, both evenly drawn.
        tilt_std_deg: 1-sigma of roll and pitch, of the ground.
    """

    plantings: int = 5
    shots: int = 32
    before: float = 4.0
    left: float = 0.5
    turn_deg: float = 10.0
    tilt_std_deg: float = 1.2


HELD_OUT = GroundPicturesParams(plantings=1, shots=20)


@dataclass(frozen=True, slots=True, eq=False)
class GroundPictures:
    """`squares` (N, S, S, 3) uint8 BGR, `masks` (N, S, S) and the `segments` (N,) that they are of."""

    squares: Bytes
    masks: Mask
    segments: tuple[Segment, ...]


def render_pictures(
    first: int, params: GroundPicturesParams, report: Callable[[str], None] | None = None
) -> GroundPictures:
    """Pictures of the tuning segments from index `first` on; the same index gives the same pictures."""
    squares: list[Bytes] = []
    masks: list[Mask] = []
    segments: list[Segment] = []
    for planting in range(params.plantings):
        for k, segment in enumerate(Segment):
            light = _LIGHTS[(planting + k) % len(_LIGHTS)]
            for frame in segment_frames(tuning_segment(segment, first + planting), light, params):
                squares.append(squeezed(frame.image))
                masks.append(squeezed_mask(frame))
                segments.append(segment)
        if report is not None:
            report(f"{len(squares)} of {params.plantings * len(Segment) * params.shots} pictures")
    return GroundPictures(np.array(squares), np.array(masks), tuple(segments))


def segment_frames(young: YoungSegment, light: LightName, params: GroundPicturesParams) -> list[RenderedFrame]:
    """Pictures along one segment with its ground."""
    orchard = build_orchard(young.site, replace(young.orchard, seed=young.seed))
    corridor, rng = segment_corridor(young), np.random.default_rng((young.seed, list(Segment).index(young.name), 37))
    scene = Scene(orchard, named_light(light, seed=young.seed))
    rendering, frames = RenderParams(corridor=corridor), []
    for number in range(params.shots):
        answer = _exposed(scene.light, rng)
        renderer = CameraRenderer(orchard, robot_camera(), answer, rendering, scene=scene)
        frames.append(renderer.render(random_pose(corridor, params, rng), number))
    return frames


def random_pose(corridor: Corridor, params: GroundPicturesParams, rng: np.random.Generator) -> SimTruth:
    """Anywhere along the corridor, looking along it."""
    along = float(rng.uniform(-params.before, LENGTH_M - 1.0))
    left, right = (float(np.interp(along, line[:, 0], line[:, 1])) for line in (corridor.left, corridor.right))
    T_map_row = corridor.T_row_map.inverse()
    x, y = T_map_row.apply_point(along, (left + right) / 2 + float(rng.uniform(-params.left, params.left)))
    turn = math.radians(params.turn_deg) * float(rng.uniform(-1.0, 1.0))
    roll, pitch = np.radians(rng.normal(0.0, params.tilt_std_deg, 2)).tolist()
    yaw = math.remainder(T_map_row.yaw + turn, 2 * math.pi)
    return SimTruth(stamp_ns=0, x=x, y=y, yaw=yaw, roll=roll, pitch=pitch, v=0.0, omega=0.0)


def squeezed_mask(frame: RenderedFrame) -> Mask:
    """A frame's ground as the net should tell it: where half of what a pixel covers is ground."""
    if frame.ground is None:
        return np.zeros((SIDE_PX, SIDE_PX), dtype=np.bool_)
    share = cv2.resize(frame.ground.astype(np.float32), (SIDE_PX, SIDE_PX), interpolation=cv2.INTER_AREA)
    return np.asarray(share >= 0.5)


def _exposed(light: LightParams, rng: np.random.Generator) -> LightParams:
    """The same sky, another answer of the camera."""
    return replace(
        light, exposure=light.exposure * float(np.exp(rng.normal(0.0, 0.2))),
        red_gain=float(np.exp(rng.normal(0.0, 0.05))), blue_gain=float(np.exp(rng.normal(0.0, 0.05))),
        blur_px=float(rng.uniform(0.3, 1.0)),
    )  # fmt: skip
