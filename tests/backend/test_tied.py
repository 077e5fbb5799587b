"""What the station starts ends with the station, even when that is killed."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from tests.living_process import ends, is_running

MAPPING = """
import subprocess, sys, time
from pathlib import Path
from threading import Thread
from backend import map3d_jobs
from backend.map3d_store import Map3dStore
from backend.tied import tied
ready = Path(sys.argv[1])
statement = f"import time; open({str(ready)!r}, 'w'); time.sleep(600)"
map3d_jobs.command = lambda log, folder: tied("timeit", "-n1", "-r1", statement)
jobs = map3d_jobs.Map3dJobs(Map3dStore(Path("maps")))
def ask():
    jobs.start("site", "run", Path("run.mcap"))
    while not ready.exists():
        time.sleep(0.01)
request = Thread(target=ask)
request.start()
request.join()
try:
    jobs._process.wait(0.5)
except subprocess.TimeoutExpired:
    print(jobs._process.pid, flush=True)
    time.sleep(600)
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the kernel tells of a parent's death on Linux only")
def test_a_map_is_made_on_behind_its_request_and_not_behind_a_station_that_was_killed(tmp_path: Path) -> None:
    command = [sys.executable, "-c", MAPPING, str(tmp_path / "ready")]
    station = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert station.stdout is not None
    mapping = int(station.stdout.readline())
    assert is_running(mapping)
    station.kill()
    station.communicate()
    assert ends(mapping)
