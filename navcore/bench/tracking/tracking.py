"""`rowpilot bench tracking`: how closely the true robot keeps to a path, by who follows it and how fast."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

import msgspec

from navcore.bench.side_by_side import side_by_side
from navcore.bench.tracking.cases import TrackingCase
from navcore.bench.tracking.drive import TrackingResult, drive_track

DRIVES = "tracking.jsonl"


def drive_all(
    cases: Iterable[TrackingCase], folder: Path, processes: int, progress: Callable[[str], None]
) -> tuple[TrackingResult, ...]:
    """Drive what is not yet in the folder; each drive is written at once."""
    folder.mkdir(parents=True, exist_ok=True)
    done, wanted = read_drives(folder / DRIVES), tuple(cases)
    left = [case for case in wanted if case not in done]
    for k, result in enumerate(side_by_side(drive_track, left, processes), start=1):
        with (folder / DRIVES).open("ab") as file:
            file.write(msgspec.json.encode(result) + b"\n")
        done[result.case] = result
        progress(_told(result, len(left) - k))
    return tuple(done[case] for case in wanted)


def read_drives(path: Path) -> dict[TrackingCase, TrackingResult]:
    """Drives by case; a torn last line is left out."""
    found = {}
    for line in path.read_bytes().splitlines() if path.exists() else ():
        try:
            result = msgspec.json.decode(line, type=TrackingResult)
        except msgspec.MsgspecError:
            continue
        found[result.case] = result
    return found


def _told(result: TrackingResult, left: int) -> str:
    case = result.case
    off = "-" if result.mean is None or result.largest is None else f"{100 * result.mean:.1f} cm, at most "
    off += "" if result.largest is None else f"{100 * result.largest:.1f} cm"
    name = f"{case.rival}, {case.localization}, {case.course} at {case.speed} m/s, seed {case.seed}"
    return f"{left:4d} left  {name}: {off} {result.why}".rstrip()
