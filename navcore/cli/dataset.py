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
    count: Annotated[int, typer.Option(help="Number of rendered pictures; with --own it may be 0.")] = 1000,
    seed: Annotated[int, typer.Option(help="Of farms, seasons, lights and poses; one each per part of a set.")] = 1,
    processes: Annotated[int, typer.Option(min=1, help="Processes that render.")] = 1,
    own: Annotated[
        list[Path] | None,
        typer.Option(metavar="FOLDER", help="Own labelled pictures beside them: COCO, YOLO or labelme."),
    ] = None,
    classes: Annotated[
        list[str] | None,
        typer.Option("--class", metavar="NAME=KIND", help="What their classes are: trunk, post or none."),
    ] = None,
) -> None:
    """Render pictures of random farms with the true boxes of trunks and posts; put own pictures beside them."""
    from navcore.errors import RowpilotError
    from navcore.training.dataset import render_dataset
    from navcore.training.own_labels import read_own
    from navcore.training.own_pictures import add_own, check_kinds, told_kinds

    try:
        kinds, pictures = told_kinds(classes or []), [picture for one in own or [] for picture in read_own(one)]
        check_kinds(pictures, kinds)
        if count or not pictures:
            render_dataset(folder, count=count, seed=seed, processes=processes, report=typer.echo)
        if pictures:
            typer.echo(f"{add_own(folder, pictures, kinds)} own pictures put beside them")
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(1) from error
