"""The job that makes a 3D map, ended from outside."""

from __future__ import annotations

import logging
from pathlib import Path

import pytest

from backend import map3d_jobs
from backend.map3d_jobs import STOPPED, Map3dJobs
from backend.map3d_store import Map3dStore
from backend.schemas import JobState
from backend.tied import tied
from tests.backend.played_robot import until


def test_a_map_under_way_when_the_station_ends_is_stopped_and_no_error(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    endless = tied("timeit", "-n1", "-r1", "import time; time.sleep(600)")
    monkeypatch.setattr(map3d_jobs, "command", lambda log, folder: endless)
    jobs = Map3dJobs(Map3dStore(tmp_path))
    with caplog.at_level(logging.ERROR, logger="rowpilot.station"):
        jobs.start("site", "run", tmp_path / "run.mcap")
        jobs.close()
        assert until(lambda: (job := jobs.get("run")) is not None and job.state is JobState.FAILED)
    assert job_message(jobs) == STOPPED
    assert caplog.records == []


def job_message(jobs: Map3dJobs) -> str:
    job = jobs.get("run")
    return "" if job is None else job.message
