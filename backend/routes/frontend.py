"""The built front end, one page for all its own addresses."""

from __future__ import annotations

from fastapi import APIRouter, Response

from backend import static_files
from backend.deps import TheStation

router = APIRouter(include_in_schema=False)


@router.get("/{path:path}")
def page(station: TheStation, path: str) -> Response:
    """A built file, or the page that draws every address of the front end."""
    return static_files.answer(path)
