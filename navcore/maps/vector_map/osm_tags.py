"""Tags of OSM elements as numbers and texts, each with its bounds."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from navcore.maps.geojson_features import Problems

_LONGEST = 200
_SPEED = re.compile(r"^\s*([0-9]*\.?[0-9]+)\s*(km/h|kmh|kph|mph|m/s)?\s*$")
_PER_UNIT = {"": 1 / 3.6, "km/h": 1 / 3.6, "kmh": 1 / 3.6, "kph": 1 / 3.6, "mph": 0.44704, "m/s": 1.0}


def finite(text: str | None) -> float | None:
    """A finite number, None for anything else."""
    try:
        value = float(text or "")
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def number_of(
    tags: Mapping[str, str], key: str, default: float, bounds: tuple[float, float], label: str, problems: Problems
) -> float:
    """A number within bounds; the default if the tag is absent."""
    given = tags.get(key)
    if given is None:
        return default
    value, (low, high) = finite(given), bounds
    if value is None or not low <= value <= high:
        problems.add(f'"{key}" of {label} is "{given[:40]}"; it must be a number from {low:g} to {high:g}.')
        return default
    return value


def text_of(tags: Mapping[str, str], key: str, default: str, label: str, problems: Problems) -> str:
    """A text of reasonable length; the default if the tag is absent."""
    given = tags.get(key, default)
    if len(given) > _LONGEST:
        problems.add(f'"{key}" of {label} must be a text of at most {_LONGEST} characters.')
        return default
    return given


def speed_limit(text: str) -> float | None:
    """m/s of a speed limit such as "10", "10 km/h" or "6 mph"; None for anything else."""
    match = _SPEED.match(text)
    return float(match[1]) * _PER_UNIT[match[2] or ""] if match else None
