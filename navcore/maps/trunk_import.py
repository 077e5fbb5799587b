"""Reading a trunk map from GeoJSON."""

from __future__ import annotations

from navcore.errors import SiteError
from navcore.geometry.geodesy import EnuFrame
from navcore.maps.feature_properties import PropertyReader
from navcore.maps.geojson_features import Problems, ReadFeature, read_features
from navcore.maps.site_map import SiteMap
from navcore.maps.trunk_map import MappedTrunk, TrunkMap

# Positions further than this from the datum are of another farm, m.
_LARGEST = 20_000.0


def import_trunks(document: object, site: SiteMap) -> TrunkMap:
    """Trunks from points of the properties id, diameter, std, times_seen and sureness; rows and numbers follow from
    where they stand.

    Args:
        document: parsed JSON.

    Raises SiteError with every problem at once; then nothing is imported.
    """
    problems = Problems()
    features = read_features(document, problems)
    if not features and not problems.found:
        problems.add("The file holds no trunks.")
    frame = EnuFrame(site.datum)
    trunks = [_trunk(feature, k, frame, problems) for k, feature in enumerate(features, start=1)]
    ids = [trunk.id for trunk in trunks if trunk is not None]
    for twice in sorted({i for i in ids if ids.count(i) > 1}) if len(set(ids)) < len(ids) else ():
        problems.add(f"The id {twice[:60]} is used twice. Give each trunk an id of its own.")
    if problems.found:
        raise SiteError("The trunk map cannot be imported. " + " ".join(problems.found), problems.found)
    return TrunkMap(trunks=tuple(trunk for trunk in trunks if trunk is not None))


def _trunk(feature: ReadFeature, number: int, frame: EnuFrame, problems: Problems) -> MappedTrunk | None:
    if feature.geometry != "Point":
        problems.add(f"{feature.title} is a {feature.geometry}; a trunk must be a Point.")
        return None
    lon, lat = feature.positions[0]
    x, y, _ = frame.to_enu(lat, lon, frame.height_m)
    if not max(abs(x), abs(y)) <= _LARGEST:
        problems.add(
            f"{feature.title} lies {max(abs(x), abs(y)) / 1000:.0f} km from the site. Choose this site's file."
        )
        return None
    read = PropertyReader(feature, problems)
    trunk = MappedTrunk(
        id=feature.id or f"imported-{number}", x=round(x, 6), y=round(y, 6), std=read.number("std", 0.1, 0.001, 10.0),
        diameter=read.number("diameter", 0.1, 0.005, 5.0),
        times_seen=round(read.number("times_seen", 1, 1, 1_000_000)), sureness=read.number("sureness", 1.0, 0.0, 1.0),
    )  # fmt: skip
    read.finish()
    return trunk
