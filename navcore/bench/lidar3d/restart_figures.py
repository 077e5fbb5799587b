"""How robots without GNSS find themselves on a block's 3D map, season by season."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from statistics import median

from navcore.bench.figure import Figure, share
from navcore.bench.lidar3d.restart_trial import (
    Restarted,
    RestartParams,
    Robot,
    Seeker,
    a_row_off,
    drive,
    robots,
    roughly,
)
from navcore.maps.ndt.ndt_map import NdtMap
from navcore.sim.orchard import Season
from navcore.sim.pear_block import PearBlock

WITHIN_S = 10.0
SEED = 40_001


@dataclass(frozen=True, slots=True, kw_only=True)
class Restarts:
    """One robot, restarted three times on the same turns: told roughly, told nothing, told a row off."""

    roughly: Restarted
    nothing: Restarted
    row_off: Restarted


def restarts(
    block: PearBlock, season: Season, ndt_map: NdtMap, count: int, tell: Callable[[str], None],
    params: RestartParams = RestartParams(),
) -> list[Restarts]:  # fmt: skip
    """`count` robots in one block."""
    row = block.site.rows[0]
    along = math.atan2(row.end[1] - row.start[1], row.end[0] - row.start[0])
    standing, found = block.trellised(season), []
    for robot in robots(block, count, SEED, params):
        told = roughly(robot.at, robot.seed)
        seekers = tuple(
            Seeker(block, ndt_map, params, said) for said in (told, None, a_row_off(told, along, robot.seed))
        )
        drive(block, season, standing, robot, seekers, params)
        found.append(
            Restarts(**dict(zip(("roughly", "nothing", "row_off"), (s.result() for s in seekers), strict=True)))
        )
        tell(f"restart at {_words(robot)}: {_outcome(found[-1])}")
    return found


def restart_figures(season: str, found: Sequence[Restarts]) -> list[Figure]:
    """Right, wrong and ambiguous; wanted is that told roughly nearly all find themselves, and that none is wrong."""
    told, nothing, off = [f.roughly for f in found], [f.nothing for f in found], [f.row_off for f in found]
    soon, times = sum(r.right and r.found_s <= WITHIN_S for r in told), [r.found_s for r in told if r.right]

    def part(name: str, count: int, least: float | None = None, most: float | None = None) -> Figure:
        what = f"{season}: restarted, {name}"
        return share(what, count, len(found), seed=SEED, at_least=least, at_most=most)

    return [
        part(f"told roughly: right within {WITHIN_S:.0f} s", soon, least=0.95),
        part("told roughly: wrong", sum(r.wrong for r in told), most=0.0),
        part("told roughly: ambiguous", sum(r.ambiguous for r in told)),
        Figure(
            figure=f"{season}: restarted, told roughly: median time", value=median(times) if times else None,
            unit="s", n=len(times), seed=SEED,
        ),
        part("told nothing: found", sum(r.right for r in nothing)),
        part("told nothing: ambiguous", sum(r.ambiguous for r in nothing)),
        part("told nothing: wrong", sum(r.wrong for r in nothing), most=0.0),
        part("told a row off: wrong", sum(r.wrong for r in off)),
    ]  # fmt: skip


def restart_words(found: Sequence[Restarts]) -> str:
    """How it went, in a line."""
    told, nothing = ([getattr(f, name) for f in found] for name in ("roughly", "nothing"))
    parts = [f"told {how} {_tally(results)}" for how, results in (("roughly", told), ("nothing", nothing))]
    return f"restarted {len(found)} times; {'; '.join(parts)}"


def _tally(results: Sequence[Restarted]) -> str:
    return f"{sum(r.right for r in results)} right, {sum(r.wrong for r in results)} wrong"


def _words(robot: Robot) -> str:
    return f"({robot.at.x:.1f}, {robot.at.y:.1f}), {'creeping' if robot.creep else 'standing'}"


def _outcome(found: Restarts) -> str:
    named = (("roughly", found.roughly), ("nothing", found.nothing), ("a row off", found.row_off))
    return ", ".join(f"told {name} {_became(what)}" for name, what in named)


def _became(what: Restarted) -> str:
    if what.wrong:
        return "wrong"
    if what.right:
        return f"right after {what.found_s:.1f} s"
    return "ambiguous" if what.ambiguous else "nowhere"
