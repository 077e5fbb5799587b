"""Prints the station's OpenAPI document, from which the front end's types are generated."""

from __future__ import annotations

import json
import sys

from backend.main import create_app
from backend.settings import Settings


def document() -> str:
    """The same text for the same code."""
    return json.dumps(create_app(Settings()).openapi(), indent=2, sort_keys=True) + "\n"


if __name__ == "__main__":
    sys.stdout.write(document())
