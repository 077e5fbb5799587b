"""`rowpilot dataset`: render labelled training pictures."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("dataset")(dataset)


def dataset(
    folder: Annotated[Path, typer.Argument(help="Folder for images/ and annotations.json (COCO).")],
    count: Annotated[int, typer.Option(help="Number of pictures.")] = 1000,
    seed: Annotated[int, typer.Option(help="Of farms, seasons, lights and poses; one each per part of a set.")] = 1,
    processes: Annotated[int, typer.Option(min=1, help="Processes that render.")] = 1,
) -> None:
    """Render pictures of random farms with the true boxes of trunks and posts."""
    from navcore.errors import RowpilotError
    from navcore.training.dataset import render_dataset

    try:
        render_dataset(folder, count=count, seed=seed, processes=processes, report=typer.echo)
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(1) from error
