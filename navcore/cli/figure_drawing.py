"""A drawing beside the figures: where it goes is looked at before hours of driving, not after."""

from __future__ import annotations

from pathlib import Path

import typer

BAD_INPUT = 2


def drawable(path: Path | None) -> Path | None:
    """For an option: refuses a file that cannot be written there."""
    if path is not None and (path.is_dir() or not path.absolute().parent.is_dir()):
        raise typer.BadParameter(f"{path} cannot be written: give a file in a folder that is there.")
    return path


def draw(path: Path, drawing: str) -> None:
    """Write it."""
    try:
        path.write_text(drawing, encoding="utf-8")
    except OSError as error:
        typer.echo(f"{path} cannot be written: {error.strerror}.", err=True)
        raise typer.Exit(BAD_INPUT) from None
