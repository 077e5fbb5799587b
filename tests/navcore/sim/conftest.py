"""A small farm for the tests of the simulated world."""

from __future__ import annotations

import pytest

from navcore.maps.site_map import Datum, Lane, Row, SiteMap, Warehouse, Zone, ZoneKind


@pytest.fixture(scope="session")
def farm() -> SiteMap:
    """Six rows of 60 m north of a road, a keep-out zone east of them."""
    return SiteMap(
        name="Test farm",
        datum=Datum(lat_deg=42.4, lon_deg=-2.1, height_m=420.0),
        warehouse=Warehouse(x=0.0, y=0.0, yaw=0.0),
        lanes=(Lane(id="road", points=((0.0, 0.0), (45.0, 0.0))),),
        rows=tuple(Row(id=f"r{i}", start=(20.0 + 3 * i, 6.0), end=(20.0 + 3 * i, 66.0)) for i in range(6)),
        zones=(
            Zone(id="pond", kind=ZoneKind.KEEP_OUT, polygon=((50.0, 5.0), (60.0, 5.0), (60.0, 15.0), (50.0, 15.0))),
        ),
    )
