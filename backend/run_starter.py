"""Starts a run: everything checked and every reason told, on disk first, moving last."""

from __future__ import annotations

import secrets
import shutil
from contextlib import suppress
from threading import Lock

from backend import documents, missions, sites, trunk_maps
from backend.audit import AuditBook
from backend.database import Database
from backend.errors import RefusedError
from backend.ids import new_id
from backend.logins import Login
from backend.models import Mission, Site
from backend.navigator import NavigatorClient
from backend.recorder import RecorderClient
from backend.robot import RobotView
from backend.runs import NewRun, RunStore
from backend.schemas import OperatorAction, RunDocument
from backend.settings import Settings
from navcore.errors import MissionError, TransportError
from navcore.messages import LinkLossPolicy, Request, RequestKind
from navcore.planning.mission_planner import plan_mission
from navcore.transport.codec import encode
from navcore.vehicle import PROFILES

CANNOT_START = "The mission cannot start."
KINDS = {
    OperatorAction.PAUSE: RequestKind.PAUSE,
    OperatorAction.RESUME: RequestKind.RESUME,
    OperatorAction.ACKNOWLEDGE: RequestKind.ACKNOWLEDGE,
}


class RunStarter:
    """One start at a time; a request to a run under way passes beside it."""

    def __init__(
        self,
        settings: Settings,
        database: Database,
        runs: RunStore,
        audit: AuditBook,
        navigator: NavigatorClient,
        recorder: RecorderClient,
        robot: RobotView,
    ) -> None:
        self._settings = settings
        self._database = database
        self._runs = runs
        self._audit = audit
        self._navigator = navigator
        self._recorder = recorder
        self._robot = robot
        self._one_start = Lock()

    def start(self, login: Login, mission_id: str, link_loss: LinkLossPolicy) -> RunDocument:
        """Start a stored mission. Raises RefusedError with every reason, and leaves nothing behind then."""
        with self._one_start:
            try:
                run = self._start(self._prepare(mission_id, link_loss))
            except RefusedError as error:
                self._audit.write(login, "start", mission_id, "refused: " + " ".join(error.reasons))
                raise
        self._audit.write(login, "start", run.id, f"mission {mission_id}, link loss {link_loss}")
        return run

    def _prepare(self, mission_id: str, link_loss: LinkLossPolicy) -> NewRun:
        with self._database.read() as session:
            mission_row = documents.find(session, Mission, mission_id)
            site_row = documents.find(session, Site, mission_row.site_id)
            mission, site = missions.mission(mission_row), sites.site_map(site_row)
            trunks = trunk_maps.of_site(session, site_row.id)
        reasons = [*self._disk_reasons(), *self._robot.start_reasons(site_row.id, site_row.name)]
        try:
            plan = plan_mission(site, mission, PROFILES[self._settings.vehicle], trunks=trunks)
        except MissionError as error:
            raise RefusedError(CANNOT_START, [*reasons, *error.reasons]) from error
        if reasons:
            raise RefusedError(CANNOT_START, reasons)
        return NewRun(
            id=new_id(),
            site_id=site_row.id,
            mission_id=mission_id,
            site=site,
            mission=mission,
            plan=plan,
            link_loss=link_loss,
        )

    def _disk_reasons(self) -> list[str]:
        if shutil.disk_usage(self._settings.data_dir).free >= self._settings.keep_free_bytes:
            return []
        return ["The station's disk is too full to log a run. Delete old runs first."]

    def _start(self, new: NewRun) -> RunDocument:
        run = self._runs.create(new)
        try:
            self._recorder.finish(None)  # of a run that ended unseen; `_prepare` saw that none is under way
            self._recorder.start(new.id, self._runs.expected_log(new.id), metadata(new))
            self._ask_to_drive(new)
        except TransportError as error:
            self._stop_late_starter(new.id)
            self._undo(new.id)
            raise RefusedError(CANNOT_START, [str(error)]) from error
        except RefusedError:
            self._undo(new.id)
            raise
        return run

    def _ask_to_drive(self, new: NewRun) -> None:
        request = Request(
            kind=RequestKind.START,
            request_id=secrets.token_hex(8),
            run_id=new.id,
            plan=new.plan,
            link_loss=new.link_loss,
        )
        reply = self._navigator.ask(request, timeout_ms=3000)
        if not reply.accepted:
            raise RefusedError(CANNOT_START, reply.reasons)
        self._robot.note_start()

    def _stop_late_starter(self, run_id: str) -> None:
        """A navigator that did not answer in time may have started all the same."""
        with suppress(TransportError):
            self._navigator.ask(Request(kind=RequestKind.STOP, request_id=secrets.token_hex(8), run_id=run_id))

    def _undo(self, run_id: str) -> None:
        with suppress(TransportError):
            self._recorder.finish(run_id)
        self._runs.forget(run_id)

    def act(self, login: Login, action: OperatorAction) -> None:
        """Pause, resume or acknowledge. Raises RefusedError with the navigator's reasons."""
        request = Request(kind=KINDS[action], request_id=secrets.token_hex(8))
        reply = self._navigator.ask(request)
        self._audit.write(login, action, "", "done" if reply.accepted else "refused: " + " ".join(reply.reasons))
        if not reply.accepted:
            raise RefusedError(f"Cannot {action} now.", reply.reasons)


def metadata(new: NewRun) -> dict[str, str]:
    """What the log says of itself beside its messages."""
    return {
        "run_id": new.id,
        "site": encode(new.site).decode(),
        "mission": encode(new.mission).decode(),
        "link_loss": new.link_loss.value,
    }
