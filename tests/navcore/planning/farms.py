"""Farms for planning: rows run north, a road lies south of them, the warehouse south-west."""

from __future__ import annotations

from navcore.maps.site_map import Datum, Lane, Point, Row, SiteMap, Warehouse, Zone, ZoneKind

DATUM = Datum(lat_deg=41.5, lon_deg=2.1, height_m=100.0)


def box(x0: float, y0: float, x1: float, y1: float) -> tuple[Point, ...]:
    return ((x0, y0), (x1, y0), (x1, y1), (x0, y1))


def zone(kind: ZoneKind, *corners: float, name: str = "") -> Zone:
    return Zone(id=f"{kind.value}-{corners}", kind=kind, polygon=box(*corners), name=name)


def farm(
    *, rows: int = 6, width: float = 2.5, length: float = 60.0, headland: float | None = None,
    zones: tuple[Zone, ...] = (),
) -> SiteMap:  # fmt: skip
    """`headland`: depth of the headlands drawn at both ends of the rows, m; None draws none."""
    right = rows * width + 5
    drawn = () if headland is None else (
        zone(ZoneKind.HEADLAND, -5, length, right, length + headland),
        zone(ZoneKind.HEADLAND, -5, -headland, right, 0)
    )  # fmt: skip
    return SiteMap(
        name="farm", datum=DATUM, warehouse=Warehouse(x=-27, y=-15, yaw=0.0), zones=(*drawn, *zones),
        lanes=(
            Lane(id="road", points=((-24, -20), (-20, -6), (-5, -5), (rows * width + 12, -6))),
            Lane(id="side", points=((-8, -3.5), (-8, length))),
        ),
        rows=tuple(
            Row(id=f"R{i}", start=(i * width, 0.0), end=(i * width, length), width=width) for i in range(rows)
        ),
    )  # fmt: skip
