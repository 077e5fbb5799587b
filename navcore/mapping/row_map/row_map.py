"""From a trellis to a proposal for the site map: rows, headlands, lanes and what stands there."""

from __future__ import annotations

from collections.abc import Sequence, Sized
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from navcore.mapping.row_map.access_lane import access_lane
from navcore.mapping.row_map.found_rows import FoundBlock, FoundRowParams, found_blocks
from navcore.mapping.row_map.headland_lanes import HeadlandLaneParams, lanes_of
from navcore.mapping.row_map.headlands import Headland, HeadlandParams, end_of, headland_of
from navcore.mapping.row_map.standing_ground import StandingGround, StandingGroundParams
from navcore.mapping.trellis.seen_cloud import SeenCloud
from navcore.mapping.trellis.trellis_reference import TrellisReference
from navcore.maps.site_map import Lane, Plant, PlantKind, Row, SiteMap, Zone, ZoneKind

Floats = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class RowMapParams:
    """Parameters of `row_map`: those of its stages, and:

    Attributes:
        closest: what stands nearer to each other along a line is not posts alone, m.
    """

    rows: FoundRowParams = field(default_factory=FoundRowParams)
    ground: StandingGroundParams = field(default_factory=StandingGroundParams)
    headlands: HeadlandParams = field(default_factory=HeadlandParams)
    lanes: HeadlandLaneParams = field(default_factory=HeadlandLaneParams)
    closest: float = 2.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RowMap:
    """What was found, in `map`; `notes` are sentences for the operator."""

    rows: tuple[Row, ...] = ()
    lanes: tuple[Lane, ...] = ()
    zones: tuple[Zone, ...] = ()
    plants: tuple[Plant, ...] = ()
    notes: tuple[str, ...] = ()


def row_map(trellis: TrellisReference, clouds: Sequence[SeenCloud], params: RowMapParams = RowMapParams()) -> RowMap:
    """Rows between the lines of posts, headlands where the ground was seen free, lanes along them."""
    blocks = found_blocks(trellis, params.rows)
    plants = _plants(trellis)
    if not blocks:
        return RowMap(plants=plants, notes=(_no_rows(trellis),))
    ground = _standing_ground(blocks, trellis, clouds, params)
    found, notes = RowMap(plants=plants), []
    for number, block in enumerate(blocks, start=1):
        ends = [headland_of(block, at_start, ground, params.headlands) for at_start in (True, False)]
        headlands = [headland for headland in ends if headland is not None]
        notes += _headland_notes(block, ends)
        found = replace(
            found, rows=found.rows + block.rows, zones=found.zones + _zones(headlands, number),
            lanes=found.lanes + lanes_of(block, headlands, ground, len(found.lanes) + 1, params.lanes),
        )  # fmt: skip
    return replace(found, notes=(_summary(trellis, found), *_spacing_notes(found.rows, params), *notes))


def added(site: SiteMap, found: RowMap) -> SiteMap:
    """The site with what was found."""
    new = fitted(site, found)
    return replace(
        site, rows=site.rows + new.rows, lanes=site.lanes + new.lanes, zones=site.zones + new.zones,
        plants=site.plants + new.plants,
    )  # fmt: skip


def fitted(site: SiteMap, found: RowMap) -> RowMap:
    """What was found as the site can take it: with ids that it has not yet, and a way from its warehouse."""
    taken = {item.id for items in (site.rows, site.lanes, site.zones) for item in items}
    access = access_lane(site, found.lanes)
    lanes = found.lanes if access is None else (*found.lanes, access)
    return replace(
        found, rows=tuple(replace(row, id=_free_id(row.id, taken)) for row in found.rows),
        lanes=tuple(replace(lane, id=_free_id(lane.id, taken)) for lane in lanes),
        zones=tuple(replace(zone, id=_free_id(zone.id, taken)) for zone in found.zones),
    )  # fmt: skip


def _free_id(wanted: str, taken: set[str]) -> str:
    number = 1
    while (identity := wanted if number == 1 else f"{wanted}-{number}") in taken:
        number += 1
    taken.add(identity)
    return identity


def _standing_ground(
    blocks: tuple[FoundBlock, ...], trellis: TrellisReference, clouds: Sequence[SeenCloud], params: RowMapParams
) -> StandingGround:
    ends = np.array([end for block in blocks for row in block.rows for end in (row.start, row.end)])
    low, high = ends.min(axis=0) - params.ground.reach, ends.max(axis=0) + params.ground.reach
    return StandingGround([cloud.points for cloud in clouds], trellis.ground, low, high, params.ground)


def _plants(trellis: TrellisReference) -> tuple[Plant, ...]:
    posts = [Plant(x=round(p.x, 3), y=round(p.y, 3), kind=PlantKind.POST) for p in trellis.posts]
    trunks = [Plant(x=round(p.x, 3), y=round(p.y, 3), kind=PlantKind.TRUNK) for p in trellis.trunks]
    return (*posts, *trunks)


def _zones(headlands: list[Headland], block: int) -> tuple[Zone, ...]:
    zones = []
    for headland in headlands:
        end = "start" if headland.at_start else "end"
        name = f"Headland {block}, {end}"
        zones.append(Zone(id=f"headland-{block}-{end}", kind=ZoneKind.HEADLAND, polygon=headland.outline, name=name))
        zones += [
            Zone(id=f"standing-{block}-{end}-{k}", kind=ZoneKind.KEEP_OUT, polygon=hole, name="Found standing there")
            for k, hole in enumerate(headland.holes, start=1)
        ]
    return tuple(zones)


def _no_rows(trellis: TrellisReference) -> str:
    return (
        f"{_count(trellis.posts, 'post')} in {_count(trellis.lines, 'line')}, and no two lines lie side by side "
        "1.2 to 12 m apart, so there is no row to drive. Map the alley between two lines of posts."
    )


def _summary(trellis: TrellisReference, found: RowMap) -> str:
    return (
        f"{_count(trellis.posts, 'post')} in {_count(trellis.lines, 'line')} and {_count(trellis.trunks, 'trunk')} "
        f"make {_count(found.rows, 'row')} to drive."
    )


def _count(things: Sized, name: str) -> str:
    return f"{len(things)} {name}{'' if len(things) == 1 else 's'}"


def _spacing_notes(rows: tuple[Row, ...], params: RowMapParams) -> list[str]:
    """A sentence where vines were taken for posts."""
    if min(row.post_spacing for row in rows) >= params.closest:
        return []
    return ["Vines stand as high as the posts here and were taken for posts. Check the ends of the rows."]


def _headland_notes(block: FoundBlock, ends: list[Headland | None]) -> list[str]:
    """A sentence for each end without a headland, and for what stands on one."""
    first, last, notes = block.rows[0], block.rows[-1], []
    for headland, at_start in zip(ends, (True, False), strict=True):
        (x0, y0), (x1, y1) = end_of(first, at_start), end_of(last, at_start)
        where = f"at the ends of {first.name} to {last.name} near ({(x0 + x1) / 2:.0f}, {(y0 + y1) / 2:.0f}) m"
        if headland is None:
            notes.append(f"No free ground was seen {where}: draw the headland, or map it by driving over it.")
        elif headland.holes:
            notes.append(f"Something stands on the headland {where}: it became a keep-out zone. Check it.")
    return notes
