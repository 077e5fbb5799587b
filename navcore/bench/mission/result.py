"""One driven case as one line of JSON: what a bench that was broken off goes on from."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import msgspec

from navcore.bench.evaluate.evaluate import Evaluation, evaluate
from navcore.bench.mission.cases import MissionCase
from navcore.bench.mission.drive import drive_case
from navcore.bench.provenance import commit
from navcore.config import RobotConfig
from navcore.errors import LogError, MissionError


@dataclass(frozen=True, slots=True, kw_only=True)
class MissionResult:
    """Attributes:
    state: of the mission at the end; "refused" where it did not start, "unplannable" where there was no plan.
    why: what the operator was told last; empty after a finished mission.
    evaluation: None where the robot never drove.
    commit: on which it was driven.
    """

    case: MissionCase
    state: str
    why: str
    evaluation: Evaluation | None
    commit: str = "unknown"

    @property
    def clean(self) -> bool:
        """Finished without a human, without touching anything, without entering a wrong row."""
        return self.evaluation is not None and self.evaluation.clean


def run_case(case: MissionCase) -> MissionResult:
    """Drive and score one case with the shipped settings."""
    made = commit()
    try:
        outcome = drive_case(case, RobotConfig())
        evaluation = evaluate(outcome.record) if outcome.record is not None else None
    except MissionError as error:
        return MissionResult(case=case, state="unplannable", why=str(error), evaluation=None, commit=made)
    except LogError as error:
        return MissionResult(case=case, state="never drove", why=str(error), evaluation=None, commit=made)
    return MissionResult(case=case, state=outcome.state, why=outcome.why, evaluation=evaluation, commit=made)


def append_result(path: Path, result: MissionResult) -> None:
    """Add a line to the file."""
    with path.open("ab") as file:
        file.write(msgspec.json.encode(result) + b"\n")


def read_results(path: Path) -> dict[str, MissionResult]:
    """Results by case id. A torn last line, of a bench that was killed, is left out."""
    if not path.exists():
        return {}
    found = {}
    for line in path.read_bytes().splitlines():
        try:
            result = msgspec.json.decode(line, type=MissionResult)
        except msgspec.MsgspecError:
            continue
        found[result.case.id] = result
    return found


def missing(cases: Iterable[MissionCase], done: dict[str, MissionResult]) -> list[MissionCase]:
    """Cases that are still to be driven."""
    return [case for case in cases if case.id not in done]
