"""`rowpilot train-ground`: the small net that segments the corridor's ground, for paper B's third rival."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("train-ground")(train_ground)


def train_ground(
    out: Annotated[Path, typer.Argument(help="File to write.")] = Path("ground.onnx"),
    plantings: Annotated[int, typer.Option(min=1, help="Of each of the five segments.")] = 5,
    shots: Annotated[int, typer.Option(min=1, help="Pictures of each planting.")] = 32,
    epochs: Annotated[int, typer.Option(min=1, help="Passes over the pictures.")] = 14,
    seed: Annotated[int, typer.Option(min=0, help="Of weights, order and augmentation.")] = 1,
    threads: Annotated[int, typer.Option(min=1, help="CPU threads.")] = 1,
) -> None:
    """Render young orchards with their ground, train the net, export it and print its IoU on plantings held out."""
    from navcore.errors import InputError, RowpilotError
    from navcore.training.ground_mask.ground_export import export_ground
    from navcore.training.ground_mask.ground_pictures import (
        HELD_OUT,
        TRAINING,
        VALIDATION,
        GroundPicturesParams,
        render_pictures,
    )
    from navcore.training.ground_mask.ground_scores import score_lines
    from navcore.training.ground_mask.ground_trainer import GroundTrainerParams
    from navcore.training.ground_mask.ground_trainer import train_ground as trained

    wanted = GroundPicturesParams(plantings=plantings, shots=shots)
    try:
        if not out.parent.is_dir():
            raise InputError(f"There is no folder {out.parent} to write {out.name} to; make it first.")
        training = render_pictures(TRAINING, wanted, typer.echo)
        held_out = render_pictures(VALIDATION, HELD_OUT, typer.echo)
        params = GroundTrainerParams(epochs=epochs, seed=seed, threads=threads)
        difference = export_ground(trained(training, held_out, params, typer.echo), out)
        typer.echo(f"{out}: {out.stat().st_size / 1e6:.2f} MB, differs from torch by at most {difference:.1e}")
        for line in score_lines(out, held_out):
            typer.echo(line)
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(1) from error
