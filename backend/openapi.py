"""Prints the station's OpenAPI document, from which the front end's types are generated."""

from __future__ import annotations

import json
import sys

from backend.main import bare_app


def document() -> str:
    """The same text for the same code."""
    return json.dumps(bare_app().openapi(), indent=2, sort_keys=True) + "\n"


if __name__ == "__main__":
    sys.stdout.write(document())
