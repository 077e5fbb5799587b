"""A trunk map for others: GeoJSON with WGS 84 points, or CSV in the site's metres."""

from __future__ import annotations

import csv
import io
from typing import Any

from navcore.geometry.geodesy import EnuFrame
from navcore.maps.site_export import feature_of
from navcore.maps.site_map import SiteMap
from navcore.maps.trunk_map import MappedTrunk, RowTrunk, TrunkMap, trunks_of_row

COLUMNS = (
    "id", "row", "side", "number", "of", "lon_deg", "lat_deg", "x", "y", "std", "diameter", "times_seen", "sureness",
)  # fmt: skip


def trunks_to_geojson(trunk_map: TrunkMap, site: SiteMap) -> dict[str, Any]:
    """A FeatureCollection that `import_trunks` reads back to within 0.1 mm. Metres in the properties."""
    frame, addresses = EnuFrame(site.datum), _addresses(trunk_map, site)
    features = [
        feature_of("Point", ((t.x, t.y),), frame, _properties(t, addresses.get(t.id))) for t in trunk_map.trunks
    ]
    return {"type": "FeatureCollection", "rowpilot": {"form": "trunks", "name": site.name}, "features": features}


def trunks_to_csv(trunk_map: TrunkMap, site: SiteMap) -> str:
    """One line a trunk under `COLUMNS`; degrees where the name says so, else metres."""
    frame, addresses = EnuFrame(site.datum), _addresses(trunk_map, site)
    text = io.StringIO()
    writer = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    for t in trunk_map.trunks:
        lat, lon, _ = frame.to_geodetic(t.x, t.y, 0.0)
        row = _properties(t, addresses.get(t.id))
        del row["kind"]
        writer.writerow(
            row | {"lon_deg": f"{lon:.9f}", "lat_deg": f"{lat:.9f}", "x": f"{t.x:.4f}", "y": f"{t.y:.4f}"}
        )
    return text.getvalue()


def _addresses(trunk_map: TrunkMap, site: SiteMap) -> dict[str, tuple[str, RowTrunk]]:
    """Of each trunk the first row that it stands on."""
    found: dict[str, tuple[str, RowTrunk]] = {}
    for row in site.rows:
        for placed in trunks_of_row(trunk_map, row):
            found.setdefault(placed.trunk.id, (row.name or row.id, placed))
    return found


def _properties(trunk: MappedTrunk, address: tuple[str, RowTrunk] | None) -> dict[str, Any]:
    where: dict[str, Any] = {"row": None, "side": None, "number": None, "of": None}
    if address is not None:
        row, placed = address
        where = {"row": row, "side": "left" if placed.side > 0 else "right", "number": placed.number, "of": placed.of}
    return {
        "kind": "trunk", "id": trunk.id, **where, "diameter": round(trunk.diameter, 4), "std": round(trunk.std, 4),
        "times_seen": trunk.times_seen, "sureness": round(trunk.sureness, 3),
    }  # fmt: skip
