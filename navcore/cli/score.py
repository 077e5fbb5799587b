"""`rowpilot score`: how well a detector finds what a labelled set holds."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

BAD_INPUT = 2


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("score")(score)


def score(
    folder: Annotated[Path, typer.Argument(help="Folder of labelled pictures with annotations.json (COCO).")],
    weights: Annotated[
        Path | None, typer.Option(help="Detector (ONNX), ours or a YOLO trained here; the shipped one without.")
    ] = None,
) -> None:
    """Print mAP50, recall, precision and the feet's errors, as a whole and by season and light."""
    from navcore.errors import RowpilotError

    try:
        typer.echo(score_table(weights, folder))
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None


def score_table(weights: Path | None, folder: Path) -> str:
    """Of what the robot would run, at its working threshold. Raises InputError and ModelError."""
    from navcore.perception.box_decoding import DecodingParams
    from navcore.training.evaluate import evaluate, table
    from navcore.training.samples import read_samples
    from navcore.training.scored_detector import scored_detector

    return table(evaluate(scored_detector(weights), read_samples(folder), DecodingParams().threshold))
