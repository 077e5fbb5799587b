"""The farm as it is handed to the robot's processes: a `SiteMap` as JSON."""

from __future__ import annotations

from pathlib import Path

from navcore.errors import InputError, SiteError
from navcore.maps.site_map import SiteMap
from navcore.transport.codec import decode


def read_site(path: Path) -> SiteMap:
    """Raises SiteError with a sentence."""
    try:
        return decode(SiteMap, path.read_bytes())
    except OSError as error:
        raise SiteError(f"The site {path.name} cannot be read: {error.strerror}.") from error
    except InputError as error:
        raise SiteError(f"The site {path.name} is unusable. {error}") from error
