"""Names of what the station stores: rows, files and jobs."""

from __future__ import annotations

import secrets


def new_id() -> str:
    """A name made by the station; no client ever names a row or a file."""
    return secrets.token_hex(8)
