"""A recorded bench of whole missions is read, scored and gone on with: 215 drives of commit 4e7ee67."""

from __future__ import annotations

import lzma
from pathlib import Path

import pytest

from navcore.bench.figure import Figure
from navcore.bench.mission.cases import CaseKind, CaseParams, mission_cases
from navcore.bench.mission.figures import mission_figures
from navcore.bench.mission.result import MissionResult, missing, read_results

RECORDED = Path(__file__).with_name("recorded_missions.jsonl.xz")


@pytest.fixture
def recorded(tmp_path: Path) -> dict[str, MissionResult]:
    path = tmp_path / "missions.jsonl"
    path.write_bytes(lzma.decompress(RECORDED.read_bytes()))
    return read_results(path)


def test_recorded_drives_are_cases_of_the_bench_and_the_others_are_left(recorded: dict[str, MissionResult]) -> None:
    cases = mission_cases(CaseParams())
    assert {case.id for case in cases} >= set(recorded)
    assert len(missing(cases, recorded)) == len(cases) - len(recorded)
    assert {result.commit for result in recorded.values()} == {"4e7ee67"}


def test_figures_count_what_was_recorded(recorded: dict[str, MissionResult]) -> None:
    figures: dict[str, Figure] = {f.figure: f for f in mission_figures(tuple(recorded.values()))}
    whole = [r for r in recorded.values() if r.case.kind in (CaseKind.MISSION, CaseKind.ROW_CHANGE)]
    finished = figures["missions finished without a human"]
    assert (finished.n, finished.value) == (len(whole), sum(r.clean for r in whole) / len(whole))
    switches = figures["largest lateral error within 2 m of a switch"]
    assert switches.value == pytest.approx(0.1380, abs=1e-4)  # m, as it was printed then
    assert switches.n == 692
    alone = figures["the same missions on GNSS alone"]
    assert alone.value is not None
    assert alone.value < 0.25
