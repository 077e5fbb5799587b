"""Rows, headlands and turns found in a simulated block, and whether missions on that map may be started."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from navcore.bench.figure import Figure, share
from navcore.errors import MissionError
from navcore.mapping.row_map.row_map import added, row_map
from navcore.mapping.row_map.u_turns import u_turns
from navcore.mapping.trellis.seen_cloud import SeenCloud
from navcore.mapping.trellis.trellis_reference import TrellisReference
from navcore.maps.mission import RowExit
from navcore.maps.site_map import Row, SiteMap, ZoneKind
from navcore.planning.mission_planner import draft_mission, mission_for_row
from navcore.sim.pear_block import PearBlock
from navcore.vehicle import SCOUT_2

TABLE = "Vector map made by itself (simulated Y-trellis pear block)"


def row_figures(block: PearBlock, trellis: TrellisReference, clouds: Sequence[SeenCloud], name: str) -> list[Figure]:
    """Of the map that is made of a trellis; only warehouse and fence are taken from the block's own map."""
    found = row_map(trellis, clouds)
    fence = tuple(zone for zone in block.site.zones if zone.kind is ZoneKind.KEEP_IN)
    site = added(replace(block.site, rows=(), lanes=(), zones=fence, plants=()), found)
    ends = [end for row in found.rows for end in _end_errors(row, block.site.rows)]
    widths = [abs(row.width - _nearest(row, block.site.rows).width) for row in found.rows]
    started, tried = _missions(site)
    turns, wanted = len(u_turns(site, SCOUT_2)), 2 * max(len(block.site.rows) - 1, 0)
    seed, true = block.seed, len(block.site.rows)
    return [
        share(f"rows found, {name}", len(found.rows), true, seed=seed, at_least=1.0, table=TABLE),
        _plain(f"largest error of a row's end, {name}", max(ends, default=None), "m", len(ends), seed),
        _plain(f"largest error of a row's width, {name}", max(widths, default=None), "m", len(widths), seed),
        share(f"missions that may be started, {name}", started, tried, seed=seed, at_least=1.0, table=TABLE),
        share(f"U turns between neighbours, {name}", turns, wanted, seed=seed, at_least=1.0, table=TABLE),
    ]


def _missions(site: SiteMap) -> tuple[int, int]:
    """Those through each row and out of it in each way, accepted and tried."""
    started = tried = 0
    for row in site.rows:
        for way_out in RowExit:
            tried += 1
            try:
                problems = draft_mission(site, mission_for_row(site, row.id, way_out), SCOUT_2)[1]
            except MissionError:
                continue
            started += not problems
    return started, tried


def _nearest(row: Row, rows: Sequence[Row]) -> Row:
    return min(rows, key=lambda other: sum(_end_errors(row, (other,))))


def _end_errors(row: Row, rows: Sequence[Row]) -> tuple[float, float]:
    """Distances of both ends from those of the nearest true row, whichever way it is directed, m."""
    ways = [
        pair
        for other in rows
        for pair in (
            (math.dist(row.start, other.start), math.dist(row.end, other.end)),
            (math.dist(row.start, other.end), math.dist(row.end, other.start)),
        )
    ]
    return min(ways, key=sum)


def _plain(figure: str, value: float | None, unit: str, n: int, seed: int) -> Figure:
    return Figure(figure=figure, value=value, unit=unit, n=n, seed=seed, table=TABLE)
