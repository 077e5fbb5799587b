"""Where the station lays a trunk map down for the 3D view, which does not read the database."""

from __future__ import annotations

from pathlib import Path


def shown_file(folder: Path, site_id: str) -> Path:
    """Of one site, in the folder of what the robot and the view were given."""
    return folder / f"{site_id}.trunks.json"
