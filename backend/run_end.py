"""What is done when a run has ended."""

from __future__ import annotations

import logging
from collections.abc import Callable
from threading import Thread

from backend.errors import RefusedError
from backend.recorder import RecorderClient
from navcore.errors import TransportError

log = logging.getLogger("rowpilot.station")


class RunEnd:
    """Closes the log of a run that is over, then hands it on. A stopped run is not over: it may be resumed until
    it is acknowledged.
    """

    def __init__(self, recorder: RecorderClient, hand_on: Callable[[str], None]) -> None:
        """`hand_on` gets the id of a run whose log is complete."""
        self._recorder, self._hand_on = recorder, hand_on

    def finish(self, run_id: str) -> None:
        """Ask the recorder, in a thread: who watches the robot must not wait for a disk."""
        Thread(target=self._finish, args=(run_id,), name="run-end", daemon=True).start()

    def _finish(self, run_id: str) -> None:
        try:
            self._recorder.finish(run_id)
        except (TransportError, RefusedError) as error:
            log.warning("the log of run %s was not closed: %s", run_id, error)
        else:
            self._hand_on(run_id)
