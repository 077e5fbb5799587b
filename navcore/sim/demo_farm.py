"""The farm that a newcomer sees first: a shed, a bent dirt road, two blocks of six rows, a pond to keep out of."""

from __future__ import annotations

import math
from dataclasses import replace

from navcore.geometry.se2 import SE2
from navcore.maps.site_map import Datum, Lane, SiteMap, Warehouse, Zone, ZoneKind
from navcore.sim.farm_parts import Block, bent_road, headland

DEMO_DATUM = Datum(
    lat_deg=42.46650, lon_deg=-2.61200, height_m=530.0, frame="ETRS89", corrections="simulated base station"
)


def demo_farm() -> SiteMap:
    """A made-up vineyard in the Rioja. Rows 1 to 6 are 70 m long and 3.0 m wide, rows 7 to 12 62 m and 2.7 m."""
    west = Block(T_map_block=SE2(34.0, 20.0, math.radians(-8.0)), name="A", rows=6, length=70.0, width=3.0)
    east = replace(
        west, T_map_block=west.T_map_block @ SE2(25.2, 0.0, 0.0), name="B", first=7, length=62.0, width=2.7,
        plant_spacing=1.2,
    )  # fmt: skip
    return SiteMap(
        name="Demo farm",
        datum=DEMO_DATUM,
        warehouse=Warehouse(x=0.0, y=0.0, yaw=0.0, name="Warehouse"),
        lanes=_lanes(west),
        rows=(*west.site_rows(), *east.site_rows()),
        zones=(
            headland(west, 1, -6.0, 43.0, -11.0, 0.0),
            headland(west, 2, -6.0, 21.5, 70.0, 81.0),
            headland(east, 3, -3.7, 17.8, 62.0, 81.0),
            *_boundaries(west),
        ),
    )


def _lanes(west: Block) -> tuple[Lane, ...]:
    """The road from the warehouse, the two headland tracks, and the track between the blocks."""
    corner = west.place(-4.0, -7.0)
    road = bent_road(((1.0, 0.0), (12.0, 0.0), (18.0, 7.0), (24.0, 14.5), corner))
    return (
        Lane(id="road", name="Farm road", points=road, width=3.2),
        Lane(id="south", name="South headland", points=(corner, west.place(20.1, -7.0), west.place(41.0, -7.0))),
        Lane(id="middle", name="Between the blocks", points=(west.place(20.1, -7.0), west.place(20.1, 76.5))),
        Lane(id="north", name="North headland", points=(west.place(-4.0, 76.5), west.place(20.1, 76.5),
                                                        west.place(41.0, 76.5))),
    )  # fmt: skip


def _boundaries(west: Block) -> tuple[Zone, ...]:
    """Where the robot may be at all, the shed, and the pond."""
    fence = (
        (-12.0, -9.0), (22.0, -9.0), west.place(-4.0, -13.0), west.place(45.0, -13.0), west.place(45.0, 83.0),
        west.place(-8.0, 83.0), west.place(-8.0, 2.0), (12.0, 12.0), (-12.0, 12.0),
    )  # fmt: skip
    shed = ((-10.6, -6.1), (-2.4, -6.1), (-2.4, 6.1), (-10.6, 6.1))
    pond = ((17.0, -7.0), (21.5, -6.0), (23.0, -2.0), (20.0, 0.5), (17.0, -2.0))
    return (
        Zone(id="fence", kind=ZoneKind.KEEP_IN, polygon=fence, name="Fence"),
        Zone(id="shed", kind=ZoneKind.KEEP_OUT, polygon=shed, name="Shed"),
        Zone(id="pond", kind=ZoneKind.KEEP_OUT, polygon=pond, name="Pond"),
    )
