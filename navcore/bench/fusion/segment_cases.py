"""Drives through paper B's segments: which chain sees the row, where, how fast, in which light."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from itertools import product

from navcore.bench.mission.cases import EyeKind
from navcore.bench.paper_b import LIGHTS
from navcore.errors import ConfigError
from navcore.sim.camera_light import LightName
from navcore.sim.young_orchard import Segment, YoungSegment, scoring_segment, tuning_segment


class Chain(StrEnum):
    """Who sees the row; the same robot drives by it.

    OURS: camera and LiDAR. ORACLE: the same fit on the true trunks, which bounds what any sensor could do.
    PUBLISHED: paper B's fusion. LIDAR, VISION: its rivals with one sensor and RANSAC. SEGMENTATION: its rival that
    segments the ground; a small net of our own stands in place of DeepLab v3+.
    """

    OURS = "ours"
    ORACLE = "true trunks"
    PUBLISHED = "fusion as published"
    LIDAR = "LiDAR + RANSAC"
    VISION = "vision + RANSAC"
    SEGMENTATION = "segmentation + skeleton"


@dataclass(frozen=True, slots=True, kw_only=True)
class SegmentCase:
    """One drive. `speed` in the row, m/s; `run` counts the plantings of a segment; `tuning`: one to tune on.

    Raises ConfigError for a segmentation without pixels: no truth stands in for what a net makes of a picture.
    """

    chain: Chain
    segment: Segment
    run: int
    speed: float
    light: LightName
    eye: EyeKind = EyeKind.PIXELS
    tuning: bool = False

    def __post_init__(self) -> None:
        if self.chain is Chain.SEGMENTATION and self.eye is not EyeKind.PIXELS:
            raise ConfigError("The segmentation drives by pictures alone: let its eye be pixels.")

    def young(self) -> YoungSegment:
        """What is driven through."""
        return (tuning_segment if self.tuning else scoring_segment)(self.segment, self.run)


@dataclass(frozen=True, slots=True, kw_only=True)
class SegmentCaseParams:
    """How many: `runs` of each of the `segments`, from `slowest` to `fastest`, m/s (paper B: 10, 0.5 to 2.0)."""

    segments: tuple[Segment, ...] = tuple(Segment)
    runs: int = 10
    slowest: float = 0.5
    fastest: float = 2.0
    eye: EyeKind = EyeKind.PIXELS
    tuning: bool = False


def segment_cases(params: SegmentCaseParams) -> tuple[SegmentCase, ...]:
    """All drives of all chains; the same run is the same orchard, speed and light for each."""
    steps = max(params.runs - 1, 1)
    return tuple(
        SegmentCase(
            chain=chain,
            segment=segment,
            run=run,
            speed=params.slowest + (params.fastest - params.slowest) * run / steps,
            light=LIGHTS[(run + i) % len(LIGHTS)],
            eye=EyeKind.PIXELS if chain is Chain.SEGMENTATION else params.eye,
            tuning=params.tuning,
        )
        for (i, segment), run, chain in product(enumerate(params.segments), range(params.runs), Chain)
    )
