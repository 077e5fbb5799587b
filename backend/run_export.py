"""The export process: `python -m backend.run_export LOG FORM TARGET`.

A process of its own, because reading a log keeps Python busy for seconds and the live feed must go on. Says in one
sentence on stdout what is wrong with a log, with exit status 3.
"""

from __future__ import annotations

import sys
from pathlib import Path

from backend.exit_status import UNREADABLE
from backend.run_track import read_track
from navcore.disk import write_durably
from navcore.errors import InputError
from navcore.promptness import stand_back
from navcore.recording.export import RunExport
from navcore.recording.reader import read_farm
from navcore.transport.codec import encode


def main() -> int:
    """Write one export, whole or not at all."""
    log, form, target = sys.argv[1:4]
    stand_back()
    try:
        text = render(Path(log), form)
    except InputError as error:
        sys.stdout.write(str(error))
        return UNREADABLE
    write_durably(Path(target), text.encode())
    return 0


def render(log: Path, form: str) -> str:
    """A log as "csv", "geojson", "gpx", "track" (JSON of `RunTrack`) or "trunks" (`TrunkMap`). Raises InputError."""
    if form == "track":
        return read_track(log).model_dump_json()
    if form == "trunks":
        # Here, because it loads scipy: whoever waits for a table of the run does not wait for that.
        from navcore.mapping.trunks_seen import trunks_seen

        return encode(trunks_seen(log, read_farm(log).rows)).decode()
    export = RunExport(log)
    forms = {"csv": export.csv, "geojson": export.geojson, "gpx": export.gpx}
    return forms[form]()


if __name__ == "__main__":
    raise SystemExit(main())
