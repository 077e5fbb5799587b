"""From a run's log, and a truth by survey or tape where there is one, to what the scorer needs."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from navcore.bench.evaluate.record import DecisionMark, RunRecord, ViewMark, decision_mark, drawn_rows, view_mark
from navcore.errors import LogError
from navcore.geometry.geodesy import EnuFrame
from navcore.messages import (
    CameraView,
    Decision,
    FixQuality,
    GnssFix,
    MissionPlan,
    ModeSwitch,
    RowObservation,
    SimContact,
    SimFarm,
    SimTruth,
    TrueRow,
)
from navcore.recording.reader import read_log, wall_offset_ns
from navcore.topics import (
    CAMERA_VIEW,
    GNSS_FIX,
    NAV_DECISION,
    NAV_PLAN,
    ROW_OBSERVATION,
    SIM_CONTACT,
    SIM_FARM,
    SIM_TRUTH,
    Topic,
)
from navcore.transport.codec import decode

Floats = NDArray[np.float64]

_READ: tuple[Topic, ...] = (
    NAV_PLAN, NAV_DECISION, CAMERA_VIEW, ROW_OBSERVATION, GNSS_FIX, SIM_TRUTH, SIM_FARM, SIM_CONTACT,
)  # fmt: skip


@dataclass(slots=True)
class RecordBuilder:
    """Collects the messages of one run in the order they come; `add` takes any message of the vocabulary."""

    plan: MissionPlan | None = None
    truth: list[tuple[float, float, float, float, float]] = field(default_factory=list)
    decisions: list[DecisionMark] = field(default_factory=list)
    switches: list[ModeSwitch] = field(default_factory=list)
    views: list[ViewMark] = field(default_factory=list)
    evidence_ns: list[int] = field(default_factory=list)
    contacts: list[SimContact] = field(default_factory=list)
    rows: tuple[TrueRow, ...] = ()

    def add(self, message: object) -> None:
        """Take one message; those that do not matter to the score are passed over."""
        match message:
            case MissionPlan():
                self.plan = message
            case Decision():
                self._add_decision(message)
            case CameraView():
                self.views.append(view_mark(message))
            case RowObservation() if message.in_sight:
                self.evidence_ns.append(message.stamp_ns)
            case GnssFix() if message.quality is FixQuality.RTK_FIXED:
                self.evidence_ns.append(message.stamp_ns)
            case SimTruth():
                self.truth.append((message.stamp_ns * 1e-9, message.x, message.y, message.yaw, message.v))
            case SimContact():
                self.contacts.append(message)
            case SimFarm():
                self.rows = message.rows

    def _add_decision(self, decision: Decision) -> None:
        self.decisions.append(decision_mark(decision))
        if decision.switch is not None:
            self.switches.append(decision.switch)

    def record(self, truth: Floats | None = None) -> RunRecord:
        """All of it. Raises LogError if the plan, the decisions or the truth are missing."""
        if self.plan is None or not self.decisions:
            raise LogError("This log holds no mission. Choose the log of a run that was started.")
        known = np.array(self.truth, dtype=np.float64).reshape(-1, 5) if truth is None else truth
        if len(known) < 2:
            raise LogError("This log holds no truth, as it comes from a real robot. Give one with --truth FILE.")
        return RunRecord(
            plan=self.plan, truth=known, decisions=tuple(self.decisions), switches=tuple(self.switches),
            views=tuple(self.views), evidence_ns=tuple(sorted(self.evidence_ns)), contacts=tuple(self.contacts),
            rows=self.rows or drawn_rows(self.plan), rows_are_true=bool(self.rows),
        )  # fmt: skip


def read_record(log: Path, truth: Path | None = None) -> RunRecord:
    """The run in a log. Raises LogError with a sentence for a log or a truth file that cannot be used."""
    builder, types = RecordBuilder(), {topic.name: topic.type for topic in _READ}
    for message in read_log(log, tuple(types)):
        builder.add(decode(types[message.name], message.payload))
    if truth is None or builder.plan is None:
        return builder.record()
    return builder.record(read_truth(truth, builder.plan.datum, wall_offset_ns(log)))


def read_truth(path: Path, datum: tuple[float, float, float], wall_offset: int) -> Floats:
    """Truth (N, 5) from a CSV with a head line.

    Columns: `stamp_ns` (the log's clock) or `utc_s` (seconds since 1970); `x`, `y` (m in the site's map) or
    `lat_deg`, `lon_deg`; `yaw` (rad) if known, else the direction of motion is taken. Raises LogError.
    """
    try:
        with path.open(encoding="utf-8-sig", newline="") as file:
            rows = [_numbers(path, number, row) for number, row in enumerate(csv.DictReader(file), start=2)]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise LogError(f"The truth in {path.name} cannot be read: {error}") from error
    if len(rows) < 2:
        raise LogError(f"{path.name} holds fewer than two positions.")
    stamps = _stamps(path, rows, wall_offset)
    x, y = _places(path, rows, datum)
    if not (np.diff(stamps) > 0.0).all():
        raise LogError(f"The times in {path.name} do not increase. Sort it, and leave out doubles.")
    vx, vy = np.gradient(x, stamps), np.gradient(y, stamps)
    yaw = np.array([row["yaw"] for row in rows]) if "yaw" in rows[0] else np.arctan2(vy, vx)
    return np.column_stack((stamps, x, y, yaw, np.hypot(vx, vy)))


def _numbers(path: Path, line: int, row: dict[str, str]) -> dict[str, float]:
    """One line as finite numbers; columns that the score does not need may hold anything."""
    wanted = ("stamp_ns", "utc_s", "x", "y", "lat_deg", "lon_deg", "yaw")
    try:
        numbers = {name: float(row[name]) for name in wanted if row.get(name) not in (None, "")}
    except ValueError as error:
        raise LogError(f"{path.name}, line {line}: {error}.") from error
    if not all(map(math.isfinite, numbers.values())):
        raise LogError(f"{path.name}, line {line}: NaN or infinity is no position.")
    return numbers


def _stamps(path: Path, rows: list[dict[str, float]], wall_offset: int) -> Floats:
    if all("stamp_ns" in row for row in rows):
        return np.array([row["stamp_ns"] * 1e-9 for row in rows])
    if all("utc_s" in row for row in rows):
        return np.array([row["utc_s"] - wall_offset * 1e-9 for row in rows])
    raise LogError(f"{path.name} needs a column stamp_ns or utc_s, filled in every line.")


def _places(path: Path, rows: list[dict[str, float]], datum: tuple[float, float, float]) -> tuple[Floats, Floats]:
    if all("x" in row and "y" in row for row in rows):
        return np.array([row["x"] for row in rows]), np.array([row["y"] for row in rows])
    if all("lat_deg" in row and "lon_deg" in row for row in rows):
        lat, lon = np.array([row["lat_deg"] for row in rows]), np.array([row["lon_deg"] for row in rows])
        east, north, _ = EnuFrame(datum).to_enu(lat, lon, np.full(len(rows), datum[2]))
        return east, north
    raise LogError(f"{path.name} needs the columns x and y, or lat_deg and lon_deg, filled in every line.")
