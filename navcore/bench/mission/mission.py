"""`rowpilot bench mission`: many whole missions in lockstep, in parallel, resumable."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from navcore.bench.mission.cases import CaseParams, mission_cases
from navcore.bench.mission.result import MissionResult, append_result, missing, read_results, run_case
from navcore.bench.provenance import machine
from navcore.bench.side_by_side import side_by_side

RESULTS = "missions.jsonl"


@dataclass(frozen=True, slots=True, kw_only=True)
class Bench:
    """What was measured, on what.

    Attributes:
        commit: those on which the results were driven, which are several where a bench was resumed on another one.
    """

    results: tuple[MissionResult, ...]
    commit: str
    machine: str


def run_bench(
    params: CaseParams, folder: Path, *, processes: int = 2, progress: Callable[[MissionResult, int], None]
) -> Bench:
    """Drive what is not yet in the folder; each result is written at once, and told with how many are left."""
    folder.mkdir(parents=True, exist_ok=True)
    cases = mission_cases(params)
    done = read_results(folder / RESULTS)
    left = missing(cases, done)
    for result in side_by_side(run_case, left, processes):
        append_result(folder / RESULTS, result)
        done[result.case.id] = result
        progress(result, len(missing(cases, done)))
    results = tuple(done[c.id] for c in cases)
    return Bench(results=results, commit=", ".join(sorted({r.commit for r in results})), machine=machine())
