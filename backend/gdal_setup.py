"""GDAL kept on a short leash: GeoTIFF only, nothing beside the file, nothing from the network."""

from __future__ import annotations

from pathlib import Path

import rasterio
from rasterio import Env
from rasterio.io import DatasetReader

OPTIONS = {
    "GDAL_DISABLE_READDIR_ON_OPEN": "EMPTY_DIR",  # no .aux.xml, .ovr or .tfw from beside the file
    "GDAL_PAM_ENABLED": "NO",
    "GDAL_CACHEMAX": 64 * 2**20,
    "GDAL_NUM_THREADS": "1",
    "GDAL_TIFF_INTERNAL_MASK": "YES",
    "GTIFF_VIRTUAL_MEM_IO": "NO",
}
# Of the import process alone, by its environment: our own tiles need VRT for warping.
DRIVERS_OFF = "VRT,HTTP,WMS,WMTS,WCS,PLMOSAIC,DERIVED,STACTA,STACIT,OGCAPI,EEDAI,DAAS"


def gdal() -> Env:
    """A context in which our options hold."""
    return Env(**OPTIONS)


def open_geotiff(path: Path) -> DatasetReader:
    """Open a plain file by the GTiff driver and no other: a VRT named .tif could read any file of the machine."""
    return rasterio.open(path.resolve(strict=True).as_posix(), driver="GTiff")
