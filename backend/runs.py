"""Runs in the database. Each keeps its own copy of site, mission and plan, so no edit can reach it."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

from sqlalchemy import select, update
from sqlalchemy.orm import Session

from backend.database import Database
from backend.errors import NotFoundError
from backend.models import Run, RunEvent
from backend.schemas import RunDetail, RunDocument, RunEventDocument, RunOutcome
from navcore.maps.mission import Mission
from navcore.maps.site_map import SiteMap
from navcore.messages import LinkLossPolicy, MissionPlan
from navcore.transport.codec import decode, encode

UNDER_WAY = (RunOutcome.STARTING.value, RunOutcome.RUNNING.value)


@dataclass(frozen=True, slots=True, kw_only=True)
class NewRun:
    """All that a run is started with."""

    id: str
    site_id: str
    mission_id: str
    site: SiteMap
    mission: Mission
    plan: MissionPlan
    link_loss: LinkLossPolicy


class RunStore:
    """The runs and their logs."""

    def __init__(self, database: Database, run_dir: Path) -> None:
        self._database = database
        self._run_dir = run_dir

    def newest(self, limit: int) -> list[RunDocument]:
        """Newest first."""
        with self._database.read() as session:
            rows = session.scalars(select(Run).order_by(Run.started.desc(), Run.id).limit(limit))
            return [self._document(row) for row in rows]

    def get(self, run_id: str) -> RunDocument:
        """Raises NotFoundError."""
        with self._database.read() as session:
            return self._document(find(session, run_id))

    def detail(self, run_id: str) -> RunDetail:
        """With the run's own copies and its events. Raises NotFoundError."""
        with self._database.read() as session:
            row = find(session, run_id)
            query = select(RunEvent).where(RunEvent.run_id == run_id).order_by(RunEvent.id)
            events = [RunEventDocument.model_validate(event) for event in session.scalars(query)]
        return RunDetail(
            **self._document(row).model_dump(),
            site=decode(SiteMap, row.site_document),
            mission=decode(Mission, row.mission_document),
            plan=decode(MissionPlan, row.plan_document),
            events=events,
        )

    def plan_bytes(self, run_id: str) -> bytes | None:
        """The plan as it was encoded, None if the run is not ours."""
        with self._database.read() as session:
            row = session.get(Run, run_id)
            return row.plan_document if row else None

    def create(self, new: NewRun) -> RunDocument:
        """On disk before anything is asked to move."""
        row = _row(new)
        with self._database.write() as session:
            session.add(row)
        return self._document(row)

    def forget(self, run_id: str) -> None:
        """Of a run that was refused: nothing moved, nothing stays."""
        with self._database.write() as session:
            session.delete(find(session, run_id))
        self.expected_log(run_id).unlink(missing_ok=True)

    def write_figures(self, run_id: str, figures: dict[str, object], events: list[RunEventDocument]) -> None:
        """Update the summary and add what happened, in one transaction; runs that are not ours are left alone."""
        with self._database.write() as session:
            if session.get(Run, run_id) is None:
                return
            session.execute(update(Run).where(Run.id == run_id).values(**figures))
            session.add_all(RunEvent(run_id=run_id, t_s=e.t_s, kind=e.kind, text=e.text) for e in events)

    def interrupt_all_but(self, run_id: str | None, reason: str) -> None:
        """Close the books on runs that nobody drives any more."""
        with self._database.write() as session:
            query = update(Run).where(Run.outcome.in_(UNDER_WAY))
            if run_id is not None:
                query = query.where(Run.id != run_id)
            session.execute(
                query.values(outcome=RunOutcome.INTERRUPTED.value, reason=reason, ended=datetime.now(UTC))
            )

    def expected_log(self, run_id: str) -> Path:
        """Where the log of a run is written; the name is ours, never a client's."""
        return self._run_dir / f"{run_id}.mcap"

    def log_path(self, run_id: str) -> Path:
        """The log of a known run. Raises NotFoundError if it or its log is missing, or leads out of the folder."""
        self.get(run_id)
        path = self.expected_log(run_id).resolve()
        if not path.is_relative_to(self._run_dir.resolve()) or not path.is_file():
            raise NotFoundError("This run has no log. It may have been deleted to make room on the disk.")
        return path

    def _document(self, row: Run) -> RunDocument:
        log = self.expected_log(row.id)
        columns = {name: getattr(row, name) for name in RunDocument.model_fields if name != "log_bytes"}
        return RunDocument(**columns, log_bytes=log.stat().st_size if log.is_file() else None)


def find(session: Session, run_id: str) -> Run:
    """The row of a run. Raises NotFoundError."""
    row = session.get(Run, run_id)
    if row is None:
        raise NotFoundError("There is no such run. Go back to the list of runs.")
    return row


def _row(new: NewRun) -> Run:
    return Run(
        id=new.id,
        site_id=new.site_id,
        mission_id=new.mission_id,
        site_name=new.site.name,
        mission_name=new.mission.name,
        site_document=encode(new.site),
        mission_document=encode(new.mission),
        plan_document=encode(new.plan),
        link_loss=new.link_loss.value,
        outcome=RunOutcome.STARTING.value,
        state=None,
        reason="",
        started=datetime.now(UTC),
        ended=None,
        duration_s=0.0,
        distance_m=0.0,
        progress=0.0,
        mean_lateral_error=None,
        max_lateral_error=None,
        mode_switches=0,
        holds=0,
    )
