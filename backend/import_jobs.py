"""Imports under way: each a process of its own, watched by a thread. A failed one leaves nothing behind."""

from __future__ import annotations

import json
import os
import re
import subprocess
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from threading import Lock, Thread, Timer
from typing import Any

from backend.errors import NotFoundError, TooLargeError
from backend.gdal_setup import DRIVERS_OFF, OPTIONS
from backend.ids import new_id
from backend.orthophoto_import import BROKEN
from backend.schemas import Job, JobState
from backend.settings import Settings
from backend.tied import tied
from navcore.errors import InputError, OrthophotoError, RowpilotError

MOST_RUNNING = 2
MOST_KEPT = 100
OURS = "The import failed by an error of the station. Nothing was changed; the log of the station has the details."
Finish = Callable[[Path, dict[str, Any]], str]
Command = Callable[[Path, Path, Settings], list[str]]


@dataclass(frozen=True, slots=True, kw_only=True)
class ImportKind:
    """What a job does with its file.

    Attributes:
        command: of its process, from the file, the target and the settings.
        error: what a sentence of the process is raised as. broken: what is said of a process that died. done: at the
            end.
    """

    command: Command
    error: type[InputError]
    broken: str
    done: str


class ImportJobs:
    """The imports since the start of the station. Safe for many threads."""

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._lock = Lock()
        self._jobs: dict[str, Job] = {}
        self._processes: set[subprocess.Popen[bytes]] = set()

    def get(self, job_id: str) -> Job:
        """How it goes. Raises NotFoundError."""
        with self._lock:
            job = self._jobs.get(job_id)
        if job is None:
            raise NotFoundError("There is no such import. It may be from before the station was started again.")
        return job

    def start(self, source: Path, finish: Finish, kind: ImportKind | None = None) -> str:
        """Import an uploaded file, which is deleted whatever happens; an orthophoto if no other kind is given.

        `finish` gets the target and what the process told of it, makes or changes the site, and returns its id.
        """
        job = Job(id=new_id(), state=JobState.RUNNING, progress=0.0, message="Waiting to begin", site_id=None)
        with self._lock:
            if sum(j.state is JobState.RUNNING for j in self._jobs.values()) >= MOST_RUNNING:
                source.unlink(missing_ok=True)
                raise TooLargeError("Other imports are running. Wait for them to finish, then try again.")
            self._jobs[job.id] = job
            self._forget_oldest()
        Thread(
            target=self._run, args=(job.id, source, finish, kind or ORTHOPHOTO), name="import", daemon=True
        ).start()
        return job.id

    def _forget_oldest(self) -> None:
        over = [job.id for job in self._jobs.values() if job.state is not JobState.RUNNING][:-MOST_KEPT]
        for job_id in over:
            del self._jobs[job_id]

    def _change(self, job_id: str, **changes: object) -> None:
        with self._lock:
            self._jobs[job_id] = self._jobs[job_id].model_copy(update=changes)

    def _run(self, job_id: str, source: Path, finish: Finish, kind: ImportKind) -> None:
        target = source.with_suffix(".tif")
        try:
            facts = self._import(job_id, source, target, kind)
            site_id = finish(target, facts)
        except RowpilotError as error:
            self._change(job_id, state=JobState.FAILED, message=str(error))
        except Exception:
            self._change(job_id, state=JobState.FAILED, message=OURS)
            raise
        else:
            self._change(job_id, state=JobState.DONE, progress=1.0, message=kind.done, site_id=site_id)
        finally:
            source.unlink(missing_ok=True)
            target.unlink(missing_ok=True)

    def _import(self, job_id: str, source: Path, target: Path, kind: ImportKind) -> dict[str, Any]:
        """Run the process to its end. Raises the kind's error with its sentence."""
        with subprocess.Popen(
            kind.command(source, target, self._settings),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env=environment(),
        ) as process:
            self._processes.add(process)
            alarm = Timer(self._settings.import_wall_s, process.kill)
            alarm.start()
            try:
                return self._follow(job_id, process, kind)
            finally:
                alarm.cancel()
                process.kill()
                self._processes.discard(process)

    def _follow(self, job_id: str, process: subprocess.Popen[bytes], kind: ImportKind) -> dict[str, Any]:
        assert process.stdout is not None
        for line in process.stdout:
            told = json.loads(line)
            if "error" in told:
                raise kind.error(told["error"])
            if "done" in told:
                facts: dict[str, Any] = told["done"]
                return facts
            self._change(job_id, progress=told["progress"], message=told["message"])
        raise kind.error(kind.broken)

    def close(self) -> None:
        """End all imports; their files go with them, or at the next start."""
        for process in tuple(self._processes):
            with suppress(ProcessLookupError):
                process.kill()


def command(source: Path, target: Path, settings: Settings) -> list[str]:
    """Of the import process."""
    return tied(
        "backend.orthophoto_import",
        str(source),
        str(target),
        f"--decoded-bytes={settings.decoded_limit_bytes}",
        f"--memory-bytes={settings.import_memory_bytes}",
        f"--cpu-s={settings.import_cpu_s}",
    )


ORTHOPHOTO = ImportKind(
    command=command,
    error=OrthophotoError,
    broken=f"{BROKEN} The import needed too much time or memory, or the picture broke its reader.",
    done="Imported",
)


def environment() -> dict[str, str]:
    """Nothing of ours but the path; GDAL reads its driver list before any code of ours runs."""
    kept = {name: os.environ[name] for name in ("PATH", "PYTHONPATH", "LANG") if name in os.environ}
    gdal = {name: str(value) for name, value in OPTIONS.items()}
    return (
        kept
        | gdal
        | {"GDAL_SKIP": DRIVERS_OFF, "OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "PROJ_NETWORK": "OFF"}
    )


def site_name(file_name: str) -> str:
    """A name for people from the name of the file: without folders and suffix."""
    stem = re.split(r"[/\\]", file_name)[-1].rpartition(".")[0] or file_name
    return re.sub(r"[\x00-\x1f\x7f]", "", stem).strip()[:80] or "New site"
