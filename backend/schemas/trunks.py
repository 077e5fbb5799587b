"""The trunk map of a site, each trunk with its addresses."""

from __future__ import annotations

from backend.schemas.base import Sent


class TrunkAddress(Sent):
    """Of a trunk beside a row. `name` is as people say it: "left trunk 30 of 52"."""

    row_id: str
    row_name: str
    name: str
    side: int
    number: int
    of: int


class TrunkDocument(Sent):
    """A trunk or post: centre and 1-sigma in `map`, m; one between two rows has an address in both."""

    id: str
    x: float
    y: float
    std: float
    diameter: float
    times_seen: int
    addresses: list[TrunkAddress]


class TrunkMapDocument(Sent):
    """All that are known of a site, and how many runs tell it."""

    trunks: list[TrunkDocument]
    runs: int


class TrunksMapped(Sent):
    """What mapping a run came to, in words and numbers."""

    message: str
    seen: int
    added: int
    total: int
