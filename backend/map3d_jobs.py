"""Makes 3D maps of runs: a process at the lowest priority, watched by a thread; a killed one can be gone on with."""

from __future__ import annotations

import json
import logging
import subprocess
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path
from threading import Lock

from backend.errors import ConflictError, NotFoundError
from backend.map3d_store import Map3dStore
from backend.schemas import JobState, Map3dJob
from backend.tied import tied

log = logging.getLogger("rowpilot.station")
BAD_INPUT = 2
STOPPED = "Stopped. What was done is kept; go on whenever you like."
BROKEN = "Mapping ended by itself, perhaps for want of memory. What was done is kept; try to go on."
BUSY = "Another 3D map is being made. Wait until it is done, or stop it."


class Map3dJobs:
    """One at a time, as each takes a processor core. Safe for many threads."""

    def __init__(self, store: Map3dStore) -> None:
        self._store = store
        self._lock = Lock()
        self._jobs: dict[str, Map3dJob] = {}
        self._process: subprocess.Popen[bytes] | None = None
        # Site and run.
        self._running: tuple[str, str] | None = None
        self._stopped = False
        # Processes end with the thread that starts them: with this one, which lives as long as the station.
        self._one_thread = ThreadPoolExecutor(1, "map3d")

    def get(self, run_id: str) -> Map3dJob | None:
        """The run's job since the station began."""
        with self._lock:
            return self._jobs.get(run_id)

    def start(self, site_id: str, run_id: str, run_log: Path) -> Map3dJob:
        """Begin, or go on. Raises ConflictError while one is made."""
        with self._lock:
            if self._running is not None:
                raise ConflictError(BUSY)
            process = self._one_thread.submit(
                subprocess.Popen, command(run_log, self._store.folder(site_id, run_id)), stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
            ).result()  # fmt: skip
            self._process, self._running, self._stopped = process, (site_id, run_id), False
            job = self._jobs[run_id] = Map3dJob(state=JobState.RUNNING, progress=0.0, message="Reading the run")
        self._one_thread.submit(self._follow, run_id, process)
        return job

    def stop(self, run_id: str) -> None:
        """End the run's job; its keyframes stay. Raises NotFoundError if there is none."""
        with self._lock:
            if self._process is None or self._running is None or self._running[1] != run_id:
                raise NotFoundError("This run is not being mapped now.")
            self._stopped = True
            self._process.kill()

    def forget(self, run_id: str) -> None:
        """Of a map that is thrown away. Raises ConflictError while it is made."""
        with self._lock:
            if self._running is not None and self._running[1] == run_id:
                raise ConflictError("This map is being made. Stop it first.")
            self._jobs.pop(run_id, None)

    def stop_site(self, site_id: str) -> None:
        """End the job of a site that is deleted, and wait for its end."""
        with self._lock:
            process = self._process if self._running is not None and self._running[0] == site_id else None
            self._stopped = self._stopped or process is not None
        if process is not None:
            process.kill()
            process.wait()

    def close(self) -> None:
        """End what is under way."""
        with self._lock:
            process, self._stopped = self._process, True
        if process is not None:
            with suppress(ProcessLookupError):
                process.kill()
        self._one_thread.shutdown(wait=False)

    def _follow(self, run_id: str, process: subprocess.Popen[bytes]) -> None:
        said = ""
        with process:
            for line in process.stderr or ():
                said = self._heard(run_id, line.decode(errors="replace").strip()) or said
        code = process.returncode
        if code not in (0, BAD_INPUT) and not self._stopped:
            log.error("mapping of run %s ended with %d: %s", run_id, code, said)
        with self._lock:
            self._jobs[run_id] = self._ended(self._jobs[run_id], code, said)
            self._running = self._process = None

    def _heard(self, run_id: str, line: str) -> str:
        """Take in progress; anything else is what it has to say."""
        try:
            told = json.loads(line)
            changes = {"progress": float(told["progress"]), "message": str(told["message"])}
        except (ValueError, TypeError, KeyError):
            return line
        with self._lock:
            self._jobs[run_id] = self._jobs[run_id].model_copy(update=changes)
        return ""

    def _ended(self, job: Map3dJob, code: int, said: str) -> Map3dJob:
        if code == 0:
            return job.model_copy(update={"state": JobState.DONE, "progress": 1.0, "message": "The 3D map is made"})
        words = STOPPED if self._stopped else said if code == BAD_INPUT and said else BROKEN
        return job.model_copy(update={"state": JobState.FAILED, "message": words})


def command(run_log: Path, folder: Path) -> list[str]:
    """Of the mapping process."""
    options = ("--gently", "--progress-json", "--json")
    return tied("navcore.cli", "map", str(run_log), "--out", str(folder), *options)
