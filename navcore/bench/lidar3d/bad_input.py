"""What goes wrong with a 3D LiDAR and its map: is it said, how soon, and is the pose still right?

Each case is a drive of a robot that goes by the map, as the mission's table of events hears of it; what is wrong with
GNSS or rows is benched elsewhere. Healthy drives beside them count false words.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import islice
from pathlib import Path

import numpy as np

from navcore.bench.figure import Figure, share
from navcore.bench.lidar3d.localization_drive import Placed, localized_with
from navcore.geometry.se2 import SE2
from navcore.maps.ndt.ndt_file import ndt_map_bytes
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.maps.site_map import Datum
from navcore.messages import LinkLossPolicy, NavMode, RunState
from navcore.mission.events.facts import EventFacts, EventParams
from navcore.mission.events.table import active_events
from navcore.mission.senses import Senses
from navcore.runtime.map_file import MapFile
from navcore.sim.block_drive import START_NS, BlockDriveParams
from navcore.sim.lidar3d import WORKING_3D, Lidar3dFaults
from navcore.sim.orchard import Season
from navcore.sim.pear_block import PearBlock
from navcore.sim.trellis.trellised import TrellisParams

LEAN = math.radians(5.0)
WRONG_M = 0.3
SEED = 50_001
# The robot knows its heading and the map's place by then; what is told before is a start.
_STARTED_S = 8.0


@dataclass(frozen=True, slots=True, kw_only=True)
class BadInput:
    """One case.

    Attributes:
        name: of it. said: events of which one must be on; empty: none may be.
        faults, from_s: of the LiDAR, and since when, s. season, trellis: as the block stands.
        foreign: the map is that of another block, which claims to lie here.
        right: the matches that are believed must be right all the same. whole: the whole row is driven.
    """

    name: str
    said: tuple[str, ...]
    faults: Lidar3dFaults = WORKING_3D
    from_s: float = 0.0
    season: Season = Season.DORMANT
    trellis: TrellisParams = field(default_factory=TrellisParams)
    foreign: bool = False
    right: bool = True
    whole: bool = False


_NO_PLACE = ("map_unsure", "map_disputed")
CASES: tuple[BadInput, ...] = (
    BadInput(name="nothing wrong, winter", said=(), whole=True),
    BadInput(name="nothing wrong, full leaf", said=(), season=Season.GROWING, whole=True),
    BadInput(name="LiDAR rolled by 5 deg", said=("lidar3d_leans",), faults=Lidar3dFaults(turned=(LEAN, 0.0, 0.0))),
    BadInput(name="LiDAR pitched by 5 deg", said=("lidar3d_leans",), faults=Lidar3dFaults(turned=(0.0, LEAN, 0.0))),
    BadInput(name="LiDAR turned by 5 deg", said=("lidar3d_turned",), faults=Lidar3dFaults(turned=(0.0, 0.0, LEAN))),
    BadInput(name="a drop before every tenth ray", said=("lidar3d_drops",), faults=Lidar3dFaults(rain=0.1),
             from_s=10.0),
    BadInput(name="drops before 4 of 10 rays", said=("lidar3d_drops",), faults=Lidar3dFaults(rain=0.4), from_s=10.0),
    BadInput(name="empty scans", said=("lidar3d_empty",), faults=Lidar3dFaults(empty=True), from_s=10.0),
    BadInput(name="half of the posts gone", said=("map_outdated",), trellis=TrellisParams(posts_gone=0.5),
             whole=True),
    BadInput(name="half of the posts gone, full leaf", said=("map_outdated",), season=Season.GROWING,
             trellis=TrellisParams(posts_gone=0.5), whole=True),
    BadInput(name="map of another block", said=_NO_PLACE, foreign=True, right=False),
)  # fmt: skip


@dataclass(frozen=True, slots=True, kw_only=True)
class Heard:
    """One turn of a case: where the robot is, and the events that are on."""

    placed: Placed
    events: frozenset[str]


def heard(
    block: PearBlock, case: BadInput, ndt_map: NdtMap, turns: int, seed: int, drive: BlockDriveParams
) -> Iterator[Heard]:  # fmt: skip
    """The first `turns` of a drive down the first row, or all of them."""
    params = replace(
        drive, seed=seed, rows=(0,), season=case.season, trellis=case.trellis, faults=case.faults,
        faults_from_s=case.from_s,
    )  # fmt: skip
    for placed, senses in islice(localized_with(block, params, ndt_map), None if case.whole else turns):
        on = active_events(map_facts(senses, placed.stamp_ns), EventParams())
        yield Heard(placed=placed, events=frozenset(event.name for event in on))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BadInputDrive:
    """One drive of a case; see `heard`."""

    block: PearBlock
    case: BadInput
    ndt_map: NdtMap
    turns: int
    seed: int


def drive_badly(d: BadInputDrive) -> tuple[str, list[Heard]]:
    """The case's name, and its turns."""
    return d.case.name, list(heard(d.block, d.case, d.ndt_map, d.turns, d.seed, BlockDriveParams()))


def map_facts(senses: Senses, now_ns: int) -> EventFacts:
    """What the table of events would look at if all but the map were well and the robot drove by it."""
    on_map = senses.on_map
    return EventFacts(
        state=RunState.DRIVING, mode=NavMode.MAP, tick_s=0.02, chassis=senses.chassis, chassis_age_s=0.0,
        system_age_s=0.0, pose_std=senses.pose_std, carried=0.0, gnss_age_s=0.0, pose_cap=None, pose_cap_reason="",
        pose_cap_passes=False, row_age_s=None, row_reason="", entrance=None, room=None, lateral_error=0.0,
        captured=True, stuck=False, held_s=0.0, arming_s=0.0, link_age_s=0.0, link_loss=LinkLossPolicy.CONTINUE,
        zone="", start_distance=None, waiting_for_gnss=False, askew=(0.0, 0.0), map_age_s=on_map.age_s(now_ns),
        map_reason=on_map.reason, map_disputed=on_map.disputed, map_match=on_map.told,
        lidar3d_turned=on_map.turned,
    )  # fmt: skip


def case_figures(case: BadInput, drives: Sequence[Sequence[Heard]], seed: int) -> list[Figure]:
    """Whether it was said, how soon, and how far off the matches were that the robot believed."""
    after = [_said_after_s(case, drive) for drive in drives]
    said = sum(math.isfinite(s) for s in after)
    off = np.array([_off(h.placed) for drive in drives for h in drive if h.placed.believed]).reshape(-1, 2)
    words = f"{case.name}: "
    noticed = (
        share(words + "noticed and said", said, len(drives), seed=seed, at_least=1.0) if case.said
        else share(words + "drives without a word", len(drives) - said, len(drives), seed=seed, at_least=1.0)
    )  # fmt: skip
    wrong = int((off[:, 1] > WRONG_M).sum())
    return [
        noticed,
        Figure(figure=words + "said after", value=max(after) if case.said and said == len(drives) else None, unit="s",
               n=len(drives), seed=seed),
        Figure(figure=words + "lateral mean of believed matches", n=len(off), seed=seed, unit="m",
               value=float(np.abs(off[:, 0]).mean()) if len(off) else None),
        share(words + "believed matches within 0.3 m", len(off) - wrong, len(off), seed=seed,
              at_least=1.0 if case.right else None),
    ]  # fmt: skip


def _said_after_s(case: BadInput, drive: Sequence[Heard]) -> float:
    """s from the fault; of a healthy drive, until the first word on the sensor or on an old map."""
    since_ns = START_NS + round(1e9 * max(case.from_s, 0.0))
    wanted = set(case.said) or {"lidar3d_empty", "lidar3d_leans", "lidar3d_turned", "lidar3d_drops", "map_outdated"}
    started_ns = START_NS + round(1e9 * _STARTED_S) if case.foreign else since_ns
    first = next((h.placed.stamp_ns for h in drive if h.placed.stamp_ns >= started_ns and wanted & h.events), None)
    return math.inf if first is None else (first - since_ns) * 1e-9


def _off(placed: Placed) -> tuple[float, float]:
    """Of a match, m to the left and as a whole."""
    off = placed.truth.inverse() @ SE2(placed.match.x, placed.match.y, placed.match.yaw)
    return off.y, math.hypot(off.x, off.y)


def file_figures(ndt_map: NdtMap, seed: int) -> list[Figure]:
    """Files that are no map of this farm: said, and no place told."""
    whole, own = ndt_map_bytes(ndt_map), ndt_map.datum
    assert own is not None
    changed = bytearray(whole)
    changed[len(whole) // 2] ^= 1
    elsewhere = replace(own, lat_deg=own.lat_deg + 0.01)
    cases = [(whole[: int(part * len(whole))], own) for part in (0.0, 0.001, 0.3, 0.9)]
    refused = [_refused(data, datum) for data, datum in (*cases, (bytes(changed), own), (whole, elsewhere))]
    return [
        share("cut-off map file: refused and said", sum(refused[:4]), 4, seed=seed, at_least=1.0),
        share("changed map file: refused and said", int(refused[4]), 1, seed=seed, at_least=1.0),
        share("map of another farm: refused and said", int(refused[5]), 1, seed=seed, at_least=1.0),
    ]


def _refused(data: bytes, datum: Datum) -> bool:
    with tempfile.TemporaryDirectory(prefix="rowpilot-map-") as folder:
        path = Path(folder) / "farm.ndt"
        path.write_bytes(data)
        read = MapFile(path, datum)
        return read.localizer is None and bool(read.reason)
