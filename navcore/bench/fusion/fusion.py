"""`rowpilot bench fusion`: paper B's parts and its drives, as published and ours; nothing was tuned on its seeds."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

import msgspec

from navcore.bench.fusion.segment_cases import SegmentCase, SegmentCaseParams
from navcore.bench.fusion.segment_drive import SegmentResult, drive_segment
from navcore.bench.side_by_side import side_by_side
from navcore.sim.young_orchard import Segment

DRIVES = "segments.jsonl"


@dataclass(frozen=True, slots=True, kw_only=True)
class FusionBenchParams:
    """How much of each.

    Attributes:
        drives: through the segments. processes: so many side by side.
        scans, fits: of the clustering and of the line fits.
    """

    drives: SegmentCaseParams = SegmentCaseParams()
    processes: int = 2
    scans: int = 200
    fits: int = 1000


QUICK_DRIVES = SegmentCaseParams(segments=(Segment.STRAIGHT, Segment.OCCLUDED), runs=1, slowest=1.0)


def drive_all(
    cases: Iterable[SegmentCase], folder: Path, processes: int, progress: Callable[[str], None]
) -> tuple[SegmentResult, ...]:
    """Drive what is not yet in the folder; each drive is written at once."""
    folder.mkdir(parents=True, exist_ok=True)
    done = read_drives(folder / DRIVES)
    wanted = tuple(cases)
    left = [case for case in wanted if case not in done]
    for result in side_by_side(drive_segment, left, processes):
        with (folder / DRIVES).open("ab") as file:
            file.write(msgspec.json.encode(result) + b"\n")
        done[result.case] = result
        progress(_told(result, sum(case not in done for case in wanted)))
    return tuple(done[case] for case in wanted)


def read_drives(path: Path) -> dict[SegmentCase, SegmentResult]:
    """Drives by case; a torn last line is left out."""
    found = {}
    for line in path.read_bytes().splitlines() if path.exists() else ():
        try:
            result = msgspec.json.decode(line, type=SegmentResult)
        except msgspec.MsgspecError:
            continue
        found[result.case] = result
    return found


def _told(result: SegmentResult, left: int) -> str:
    case = result.case
    reached = sum(off is not None for off in result.off)
    why = f" {result.why}" if result.why else ""
    return f"{left:4d} left  {case.segment}/{case.run}/{case.speed:.2f}/{case.light}/{case.chain}: {reached} m{why}"
