"""Average precision of a detector, and what a row fit needs to know of it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.perception.box_decoding import overlap
from navcore.training.samples import Labels

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# A detection is on the object whose foot is nearest to its own, if it is nearer than that, px.
NEAR_PX = 8.0

# What became of a detection.
TRUE, FALSE, UNASKED = 1, 0, -1


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Found:
    """What a detector found in one picture, best first: boxes (N, 4), confidences (N,), indices into `KINDS` (N,)."""

    boxes: Floats
    confidence: Floats
    kinds: Ints

    def of_kind(self, kind: int) -> Found:
        """Those of one class."""
        mask = self.kinds == kind
        return Found(boxes=self.boxes[mask], confidence=self.confidence[mask], kinds=self.kinds[mask])


def average_precision(found: list[Found], labels: list[Labels], kind: int, min_overlap: float = 0.5) -> float:
    """Area under the precision-recall curve of one class, all points interpolated (PASCAL VOC 2010).

    NaN without truth. Detections on ignored objects count neither way.
    """
    verdicts, confidence, truths = [], [], 0
    for one, truth in zip(found, labels, strict=True):
        own = one.of_kind(kind)
        verdicts.append(judge(own.boxes, truth, kind, min_overlap))
        confidence.append(own.confidence)
        truths += int(np.count_nonzero((truth.kinds == kind) & ~truth.ignore))
    if truths == 0:
        return float("nan")
    return _area(np.concatenate(verdicts), np.concatenate(confidence), truths)


def mean_average_precision(found: list[Found], labels: list[Labels], min_overlap: float = 0.5) -> float:
    """Mean over the classes that occur; NaN if none does."""
    values = np.array([average_precision(found, labels, kind, min_overlap) for kind in (0, 1)])
    return float(np.nanmean(values)) if np.isfinite(values).any() else float("nan")


@dataclass(frozen=True, slots=True, kw_only=True)
class Hits:
    """Of detections that are all meant: `true` ones, those that were `meant`, and objects that were `asked` for."""

    true: int
    meant: int
    asked: int


def hits(found: list[Found], labels: list[Labels], min_overlap: float = 0.5) -> Hits:
    """Of both classes together; detections on ignored objects count neither way."""
    true = meant = 0
    for one, truth in zip(found, labels, strict=True):
        verdicts = np.concatenate([judge(one.of_kind(k).boxes, truth, k, min_overlap) for k in (0, 1)])
        true += int(np.count_nonzero(verdicts == TRUE))
        meant += int(np.count_nonzero(verdicts != UNASKED))
    return Hits(true=true, meant=meant, asked=sum(int(np.count_nonzero(~truth.ignore)) for truth in labels))


def judge(boxes: Floats, truth: Labels, kind: int, min_overlap: float) -> Ints:
    """Verdict on each box (N, 4) of one class, best first; a true object is found once.

    What is no true one is still not wrong if it is on an ignored object: one of the two covers more than half of the
    other, or no object that counts has its foot as near as the ignored one.
    """
    counts = (truth.kinds == kind) & ~truth.ignore
    open_truths, others = truth.boxes[counts], truth.boxes[truth.ignore]
    at_ignored = _stands_at_ignored(boxes, truth)
    taken = np.zeros(len(open_truths), dtype=np.bool_)
    verdicts = np.full(len(boxes), FALSE, dtype=np.int64)
    for i, box in enumerate(boxes):
        fit = np.where(taken, 0.0, overlap(open_truths, box))
        if len(fit) and fit.max() >= min_overlap:
            taken[int(fit.argmax())], verdicts[i] = True, TRUE
        elif at_ignored[i] or np.any(np.maximum(_covered(others, box), _covered(box[None], others)) > 0.5):
            verdicts[i] = UNASKED
    return verdicts


def _stands_at_ignored(boxes: Floats, truth: Labels) -> NDArray[np.bool_]:
    """Which of the boxes (N, 4) have their foot near an ignored object's, and nearer than to any that counts."""
    away = np.hypot(*np.moveaxis(feet(boxes)[:, None] - feet(truth.boxes), 2, 0))
    ignored = np.where(truth.ignore, away, np.inf).min(axis=1, initial=np.inf)
    counted = np.where(truth.ignore, np.inf, away).min(axis=1, initial=np.inf)
    return np.asarray((ignored <= NEAR_PX) & (ignored < counted))


def feet(boxes: Floats) -> Floats:
    """Middles (N, 2) of the boxes' lower edges."""
    return np.column_stack(((boxes[:, 0] + boxes[:, 2]) / 2, boxes[:, 3]))


def _covered(others: Floats, boxes: Floats) -> Floats:
    """Share of `boxes` that the others cover; (..., 4) each, broadcast."""
    width = np.minimum(others[..., 2], boxes[..., 2]) - np.maximum(others[..., 0], boxes[..., 0])
    height = np.minimum(others[..., 3], boxes[..., 3]) - np.maximum(others[..., 1], boxes[..., 1])
    area = np.maximum((boxes[..., 2] - boxes[..., 0]) * (boxes[..., 3] - boxes[..., 1]), 1e-9)
    return np.asarray(np.maximum(width, 0.0) * np.maximum(height, 0.0) / area)


def _area(verdicts: Ints, confidence: Floats, truths: int) -> float:
    asked = verdicts != UNASKED
    order = np.argsort(-confidence[asked], kind="stable")
    true = (verdicts[asked] == TRUE)[order]
    if len(true) == 0:
        return 0.0
    hits = np.cumsum(true)
    recall, precision = hits / truths, hits / np.arange(1, len(true) + 1)
    envelope = np.maximum.accumulate(precision[::-1])[::-1]
    return float(np.sum(np.diff(np.concatenate(([0.0], recall))) * envelope))
