"""Finds the built front end."""

from __future__ import annotations

from pathlib import Path

from starlette.responses import FileResponse, HTMLResponse, Response

from backend.errors import NotFoundError

STATIC = Path(__file__).parent / "static"
NOT_BUILT = """<!doctype html><html lang="en"><meta charset="utf-8"><title>Rowpilot</title>
<body><h1>The front end is not built</h1>
<p>The station runs, but its pages are missing. In the project folder run <code>make frontend</code>, then load this
page again.</p></body></html>"""


def answer(path: str, root: Path = STATIC) -> Response:
    """A file below `root`; for any other address without a dot in its last part, the one page of the front end."""
    file = find(path, root)
    if file is not None:
        return FileResponse(file, headers={"Cache-Control": cache_control(path)})
    if path.startswith(("api/", "scene/")) or "." in path.rpartition("/")[2]:
        raise NotFoundError("There is nothing at this address.")
    index = root / "index.html"
    if not index.is_file():
        return HTMLResponse(NOT_BUILT, 503)
    return FileResponse(index, headers={"Cache-Control": "no-cache"})


def find(path: str, root: Path) -> Path | None:
    """The file of an address, None for what no file can be called and for what leads out of `root`."""
    try:
        file = (root / path).resolve()
        return file if file.is_file() and file.is_relative_to(root.resolve()) else None
    except (OSError, ValueError):  # too long, or with a NUL in it
        return None


def cache_control(path: str) -> str:
    """Vite puts a digest into the names below `assets/`, so these never change."""
    return "public, max-age=31536000, immutable" if path.startswith("assets/") else "no-cache"
