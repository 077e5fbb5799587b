"""Rows that were found in a 3D map."""

from __future__ import annotations

from backend.schemas.base import Sent
from navcore.maps.site_map import Lane, Plant, Row, Zone


class RowProposal(Sent):
    """What would be added to a site. Ids are free in the site as it was stored; `notes` are for the operator."""

    file_name: str
    rows: list[Row]
    lanes: list[Lane]
    zones: list[Zone]
    plants: list[Plant]
    notes: list[str]
