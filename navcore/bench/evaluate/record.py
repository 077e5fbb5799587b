"""What the scorer needs of one run, wherever it comes from: a log, or a run in lockstep."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from navcore.messages import (
    CameraView,
    Decision,
    MissionPlan,
    ModeSwitch,
    NavMode,
    RunState,
    SimContact,
    TrueRow,
)

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class DecisionMark:
    """What the score looks at in one decision."""

    stamp_ns: int
    state: RunState
    mode: NavMode
    segment: int
    commands: bool


@dataclass(frozen=True, slots=True, kw_only=True)
class ViewMark:
    """The centre line seen in one picture: its angle from the picture's vertical, rad, None without a line."""

    stamp_ns: int
    valid: bool
    angle: float | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class RunRecord:
    """One run.

    Attributes:
        plan: as driven.
        truth: (N, 5) stamp in s, x, y, yaw, v in `map`; stamps increase.
        decisions, switches, views: in order of their stamps.
        evidence_ns: stamps at which valid row observations and RTK fixes were captured, in order.
        rows: the true rows; those of the plan as drawn where nobody knows better (`rows_are_true` False).
    """

    plan: MissionPlan
    truth: Floats
    decisions: tuple[DecisionMark, ...]
    switches: tuple[ModeSwitch, ...]
    views: tuple[ViewMark, ...]
    evidence_ns: tuple[int, ...]
    contacts: tuple[SimContact, ...]
    rows: tuple[TrueRow, ...]
    rows_are_true: bool


def decision_mark(decision: Decision) -> DecisionMark:
    """The mark of a decision."""
    s = decision.status
    return DecisionMark(
        stamp_ns=decision.stamp_ns, state=s.state, mode=s.mode, segment=s.segment,
        commands=decision.command is not None,
    )  # fmt: skip


def view_mark(view: CameraView) -> ViewMark:
    """The mark of a picture. The published reading: the angle of the fitted centre line in the image plane."""
    line = view.centre
    angle = None if line is None else float(np.arctan2(line.u1 - line.u0, line.v0 - line.v1))
    return ViewMark(stamp_ns=view.stamp_ns, valid=view.row.in_sight, angle=angle)


def drawn_rows(plan: MissionPlan) -> tuple[TrueRow, ...]:
    """The rows as the plan has them."""
    found: dict[str, TrueRow] = {}
    for s in plan.segments:
        if s.row_id is not None and s.row_start is not None and s.row_end is not None and s.row_id not in found:
            width = s.corridor_width or 3.0
            found[s.row_id] = TrueRow(id=s.row_id, start=s.row_start, end=s.row_end, width=width)
    return tuple(found.values())
