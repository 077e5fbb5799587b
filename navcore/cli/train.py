"""`rowpilot train`: train the detector on labelled pictures."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("train")(train)


def train(
    data: Annotated[Path, typer.Argument(help="Folder of training pictures with annotations.json (COCO).")],
    validation: Annotated[Path, typer.Argument(help="Folder of pictures that are not trained on.")],
    out: Annotated[Path, typer.Option(help="Folder for last.pt, best.pt and feet.onnx.")] = Path("training"),
    epochs: Annotated[int, typer.Option(min=1, help="Passes over the training pictures.")] = 24,
    seed: Annotated[int, typer.Option(help="Of weights, order and augmentation.")] = 1,
    threads: Annotated[int, typer.Option(min=1, help="CPU threads.")] = 1,
    resume: Annotated[bool, typer.Option(help="Go on from OUT/last.pt.")] = False,
) -> None:
    """Train the trunk and post detector, keep the best weights, export them for the robot and print their scores."""
    from navcore.errors import RowpilotError
    from navcore.training.samples import read_samples
    from navcore.training.trainer import Trainer, TrainerParams

    try:
        params = TrainerParams(epochs=epochs, seed=seed, threads=threads)
        trainer = Trainer(out, read_samples(data), read_samples(validation), params)
        if resume:
            trainer.resume()
        best = trainer.run(typer.echo)
        _ship(best, out / "feet.onnx", validation, params.threshold)
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(1) from error


def _ship(best: Path, path: Path, validation: Path, threshold: float) -> None:
    """Export, compare with torch, and score what the robot would run."""
    from navcore.perception.box_decoding import DecodingParams
    from navcore.perception.onnx_detector import OnnxDetector, OnnxDetectorParams
    from navcore.training.evaluate import evaluate, table
    from navcore.training.export import export_onnx
    from navcore.training.samples import read_samples
    from navcore.training.trainer import load_net

    difference = export_onnx(load_net(best), path)
    typer.echo(f"{path}: {path.stat().st_size / 1e6:.2f} MB, differs from torch by at most {difference:.1e}")
    detector = OnnxDetector(OnnxDetectorParams(weights=path, decoding=DecodingParams(threshold=0.05)))
    typer.echo(table(evaluate(detector, read_samples(validation), threshold)))
