"""From the clouds of one or more runs to a proposal for the site map, in one call."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from navcore.mapping.row_map.row_map import RowMap, RowMapParams, row_map
from navcore.mapping.trellis.seen_cloud import SeenCloud
from navcore.mapping.trellis.trellis_reference import TrellisParams, TrellisReference, trellis_reference


def map_rows(
    clouds: Sequence[SeenCloud],
    trellis: TrellisParams = TrellisParams(),
    rows: RowMapParams = RowMapParams(),
    tell: Callable[[str], None] = lambda _: None,
) -> tuple[RowMap, TrellisReference]:
    """What was found, and the trellis that it rests on. Raises CloudError where there is nothing to work on."""
    reference = trellis_reference(clouds, trellis, wires=False, cells=False, tell=tell)
    tell("Finding rows and headlands")
    return row_map(reference, clouds, rows), reference
