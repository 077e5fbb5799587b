"""Replays the log of a run: the same settings, the same inputs, and therefore the same decisions."""

from __future__ import annotations

from pathlib import Path

import msgspec

from navcore.config import RobotConfig, config_of_run
from navcore.errors import LogError
from navcore.maps.site_map import Datum
from navcore.recording.reader import read_decisions, read_inputs, read_prelude
from navcore.runtime.replay import ReplayResult, replay


def replay_log(path: Path, config: RobotConfig | None = None) -> ReplayResult:
    """Replay a whole run with the settings it was driven with, or with others to see where they would differ.

    Raises LogError where the log does not hold all that the navigator consumed.
    """
    prelude = read_prelude(path)
    if prelude is None:
        raise LogError(f"{path.name} does not tell what the navigator knew before the run. It cannot be replayed.")
    if not prelude.complete:
        raise LogError(
            f"{path.name} does not hold all that the navigator knew before the run. It cannot be replayed."
        )
    lat_deg, lon_deg, height_m = prelude.datum
    own = config_of_run(msgspec.json.decode(prelude.config))
    datum = Datum(lat_deg=lat_deg, lon_deg=lon_deg, height_m=height_m)
    return replay(config or own, datum, read_inputs(path), read_decisions(path), prelude.inputs)
