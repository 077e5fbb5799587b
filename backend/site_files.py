"""GeoJSON from a browser, looked at before navcore reads it."""

from __future__ import annotations

import json
from typing import Any

from navcore.errors import SiteError


def check_text(document: dict[str, Any]) -> dict[str, Any]:
    """The document, if it can be written down again. Raises SiteError for NaN and for text that is no Unicode."""
    try:
        json.dumps(document, ensure_ascii=False, allow_nan=False).encode()
    except (ValueError, RecursionError) as error:  # UnicodeEncodeError is a ValueError
        raise SiteError(
            "This GeoJSON holds NaN, infinity, broken text or too many levels. Export it again."
        ) from error
    return document
