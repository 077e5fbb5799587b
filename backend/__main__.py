"""`python -m backend` serves the station with the settings of the environment."""

from __future__ import annotations

from backend.server import serve
from backend.settings import Settings

if __name__ == "__main__":
    serve(Settings())
