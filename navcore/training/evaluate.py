"""A network's scores on a labelled set, as a whole and by season and light."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from navcore.messages import DetectedObject
from navcore.perception.box_decoding import KINDS
from navcore.perception.detector import Detector
from navcore.training.average_precision import Found, Hits, hits, mean_average_precision
from navcore.training.foot_scores import FootScores, foot_scores
from navcore.training.samples import Labels, Sample

# The average precision needs the whole curve, so also what the robot would not believe.
LOW_THRESHOLD = 0.05


@dataclass(frozen=True, slots=True, kw_only=True)
class Scores:
    """Of `pictures` pictures: mean average precision at IoU 0.5, and at the working threshold the boxes that hit with
    that overlap, and the feet."""

    name: str
    pictures: int
    map50: float
    hits: Hits
    feet: FootScores


def evaluate(detector: Detector, samples: Sequence[Sample], threshold: float) -> tuple[Scores, ...]:
    """Scores of all pictures, then of each season and each light that is told. The detector must not cut at the
    threshold itself, or the average precision misses the tail of the curve."""
    found = detect_all(detector, samples)
    groups = [("all", np.ones(len(samples), dtype=np.bool_))]
    for told in ([s.season for s in samples], [s.light for s in samples]):
        groups += [(name, np.array([t == name for t in told])) for name in sorted(set(told) - {""})]
    labels = [s.labels for s in samples]
    return tuple(
        score(name, [found[i] for i in np.flatnonzero(mask)], [labels[i] for i in np.flatnonzero(mask)], threshold)
        for name, mask in groups
    )


def detect_all(detector: Detector, samples: Sequence[Sample]) -> list[Found]:
    """What the detector finds in each picture."""
    return [_found(detector.detect(sample.image())) for sample in samples]


def score(name: str, found: list[Found], labels: list[Labels], threshold: float) -> Scores:
    """Scores of what was found in pictures with those labels."""
    meant = [above(one, threshold) for one in found]
    return Scores(
        name=name, pictures=len(found), map50=mean_average_precision(found, labels), hits=hits(meant, labels),
        feet=foot_scores(meant, labels),
    )  # fmt: skip


def above(found: Found, threshold: float) -> Found:
    """The detections of at least that confidence."""
    mask = found.confidence >= threshold
    return Found(boxes=found.boxes[mask], confidence=found.confidence[mask], kinds=found.kinds[mask])


def _found(objects: Sequence[DetectedObject]) -> Found:
    return Found(
        boxes=np.array([(o.x1, o.y1, o.x2, o.y2) for o in objects], dtype=np.float64).reshape(-1, 4),
        confidence=np.array([o.confidence for o in objects], dtype=np.float64),
        kinds=np.array([KINDS.index(o.kind) for o in objects], dtype=np.int64),
    )


def table(scores: Sequence[Scores]) -> str:
    """The scores as lines of text; feet are median absolute errors and the mean error of v, px."""
    head = (
        f"{'set':<12}{'pictures':>9}{'mAP50':>8}{'recall':>8}{'precision':>11}{'foot u':>8}{'v px':>8}{'bias v':>8}"
    )
    lines = [
        f"{s.name:<12}{s.pictures:>9}{s.map50:>8.3f}{s.feet.recall:>8.3f}{s.feet.precision:>11.3f}"
        f"{s.feet.median_u_px:>8.2f}{s.feet.median_v_px:>8.2f}{s.feet.bias_v_px:>8.2f}"
        for s in scores
    ]
    return "\n".join([head, *lines])
