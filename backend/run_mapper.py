"""Maps the trunks that a run saw: by itself when the run has ended, or when somebody asks for it."""

from __future__ import annotations

import logging

from backend.errors import NotFoundError
from backend.exports import ExportStore
from backend.runs import RunStore
from backend.schemas import TrunksMapped
from backend.trunk_maps import TrunkMapStore
from navcore.errors import RowpilotError
from navcore.maps.trunk_map import TrunkMap
from navcore.transport.codec import decode

log = logging.getLogger("rowpilot.station")


class RunMapper:
    """Reads the log in a process of its own, then takes the trunks into the site's map."""

    def __init__(self, runs: RunStore, exports: ExportStore, maps: TrunkMapStore) -> None:
        self._runs, self._exports, self._maps = runs, exports, maps

    def map(self, run_id: str) -> TrunksMapped:
        """Raises NotFoundError, LogError for a broken log and SiteError for an ambiguous run; the map stays then."""
        run = self._runs.get(run_id)
        if run.site_id is None:
            raise NotFoundError("The site of this run was deleted, and its trunk map with it.")
        path = self._exports.trunks(self._runs.log_path(run_id))
        return self._maps.add(run.site_id, run_id, decode(TrunkMap, path.read_bytes()))

    def map_ended(self, run_id: str) -> None:
        """The same for a run that has just ended: nobody waits for an answer."""
        try:
            told = self.map(run_id)
        except RowpilotError as error:
            log.warning("the trunks of run %s were not mapped: %s", run_id, error)
        else:
            log.info("the trunks of run %s: %s", run_id, told.message)
