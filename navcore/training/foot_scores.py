"""How well feet are found, whatever the box above them: what the row fit lives on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.training.average_precision import NEAR_PX, Found, feet
from navcore.training.samples import Labels

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class FootScores:
    """Over a set of pictures.

    Attributes:
        recall, precision: shares, 0 to 1; a foot is found if a box of any class stands within `near_px` of it.
        median_u_px, median_v_px: median absolute error of the found feet.
        std_u_px, std_v_px: root mean square of it.
        bias_v_px: mean error, positive if feet are seen too low.
    """

    recall: float
    precision: float
    median_u_px: float
    median_v_px: float
    std_u_px: float
    std_v_px: float
    bias_v_px: float


def foot_scores(found: list[Found], labels: list[Labels], near_px: float = NEAR_PX) -> FootScores:
    """Scores of detections that are all meant (already cut at the working threshold)."""
    errors, found_count, truths, meant = [np.zeros((0, 2))], 0, 0, 0
    for one, truth in zip(found, labels, strict=True):
        pairs, unasked = _pairs(feet(one.boxes), feet(truth.boxes), truth.ignore, near_px)
        asked_pairs = [(i, j) for i, j in pairs if not truth.ignore[j]]
        errors.extend(feet(one.boxes)[i : i + 1] - feet(truth.boxes)[j] for i, j in asked_pairs)
        found_count += len(asked_pairs)
        truths += int(np.count_nonzero(~truth.ignore))
        meant += len(one.boxes) - unasked
    error = np.concatenate(errors)
    if not len(error):
        nan = float("nan")
        return FootScores(recall=0.0, precision=0.0, median_u_px=nan, median_v_px=nan, std_u_px=nan, std_v_px=nan,
                          bias_v_px=nan)  # fmt: skip
    median, rms = np.median(np.abs(error), axis=0), np.sqrt(np.mean(error**2, axis=0))
    return FootScores(
        recall=found_count / max(truths, 1), precision=found_count / max(meant, 1), median_u_px=float(median[0]),
        median_v_px=float(median[1]), std_u_px=float(rms[0]), std_v_px=float(rms[1]),
        bias_v_px=float(error[:, 1].mean()),
    )  # fmt: skip


def _pairs(
    found: Floats, truths: Floats, ignore: NDArray[np.bool_], near_px: float
) -> tuple[list[tuple[int, int]], int]:
    """Detections with the truth nearest to them, each truth once, best detection first; and how many are unasked.

    Counted truths come before ignored ones.
    """
    pairs: list[tuple[int, int]] = []
    taken, unasked = np.zeros(len(truths), dtype=np.bool_), 0
    for i, foot in enumerate(found):
        away = np.hypot(*(truths - foot).T)
        j = _nearest(away, ~taken & ~ignore, near_px)
        j = _nearest(away, ~taken & ignore, near_px) if j is None else j
        if j is not None:
            taken[j] = True
            unasked += int(ignore[j])
            pairs.append((i, j))
    return pairs, unasked


def _nearest(away: Floats, allowed: NDArray[np.bool_], near_px: float) -> int | None:
    """The nearest of the allowed, within `near_px`."""
    if not allowed.any():
        return None
    j = int(np.where(allowed, away, np.inf).argmin())
    return j if away[j] <= near_px else None
