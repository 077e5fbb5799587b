"""The parts of a running station."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class Station:
    """What the routes work with."""

    settings: Any
    database: Any
    logins: Any
    audit: Any
    sites: Any
    missions: Any
    runs: Any
    jobs: Any
    pictures: Any
    hub: Any
    robot: Any
    driver: Any
    stopper: Any
    nonces: Any
    replay: Any
    exports: Any
    vehicle: Any
