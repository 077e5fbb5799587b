"""`rowpilot bench mission`: many whole missions in lockstep, in parallel, resumable."""

from __future__ import annotations

import multiprocessing
import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from navcore.bench.mission_cases import CaseParams, MissionCase, mission_cases
from navcore.bench.mission_result import MissionResult, append_result, missing, read_results, run_case
from navcore.bench.provenance import machine

RESULTS = "missions.jsonl"
# One thread each: two missions side by side keep two cores busy as they are.
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMBA_NUM_THREADS")


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
    for result in _driven(left, processes):
        append_result(folder / RESULTS, result)
        done[result.case.id] = result
        progress(result, len(missing(cases, done)))
    results = tuple(done[c.id] for c in cases)
    return Bench(results=results, commit=", ".join(sorted({r.commit for r in results})), machine=machine())


def _driven(cases: list[MissionCase], processes: int) -> Iterator[MissionResult]:
    if processes <= 1 or len(cases) <= 1:
        yield from map(run_case, cases)
        return
    # Fresh interpreters: forked ones would share the state of compiled code and thread pools.
    with single_threaded(), multiprocessing.get_context("spawn").Pool(processes, maxtasksperchild=8) as pool:
        yield from pool.imap_unordered(run_case, cases)


@contextmanager
def single_threaded() -> Iterator[None]:
    """Processes that are started inside reckon in one thread each."""
    before = {name: os.environ.get(name) for name in _ONE_THREAD}
    os.environ.update(dict.fromkeys(_ONE_THREAD, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
