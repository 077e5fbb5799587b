"""`rowpilot train`: train the detector on labelled pictures."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from navcore.training.augment import AugmentParams
    from navcore.training.samples import Sample
    from navcore.training.start import Start
    from navcore.training.trainer import TrainerParams


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("train")(train)


def train(
    data: Annotated[Path, typer.Argument(help="Folder of training pictures with annotations.json (COCO).")],
    validation: Annotated[Path, typer.Argument(help="Folder of pictures that are not trained on.")],
    out: Annotated[Path, typer.Option(help="Folder for last.pt, best.pt and detector.onnx.")] = Path("training"),
    net: Annotated[
        str | None,
        typer.Option(
            help="small or large (ours), or as published: yolov8n, rescbam, eca, gam, sa; else that of --from."
        ),
    ] = None,
    begin: Annotated[
        Path | None,
        typer.Option("--from", metavar="WEIGHTS", help="Begin with a best.pt or a feet.onnx instead of at random."),
    ] = None,
    head_only: Annotated[
        bool, typer.Option("--head-only", help="With --from: only the last layers, in minutes on one core.")
    ] = False,
    boxes_only: Annotated[
        bool, typer.Option("--boxes-only", help="So, too, but feet stay found as they are: only boxes learn.")
    ] = False,
    rate: Annotated[
        float | None, typer.Option(min=1e-7, help="Highest learning rate; without: the network's own.")
    ] = None,
    epochs: Annotated[int, typer.Option(min=1, help="Passes over the training pictures.")] = 24,
    minutes: Annotated[float | None, typer.Option(min=0.05, help="No longer than so.")] = None,
    batch: Annotated[int, typer.Option(min=2, help="Pictures per step.")] = 12,
    crop: Annotated[tuple[int, int], typer.Option(help="Width and height trained on, px, multiples of 32.")] = (
        256,
        192,
    ),
    seed: Annotated[int, typer.Option(help="Of weights, order and augmentation.")] = 1,
    device: Annotated[str, typer.Option(help="cpu, cuda, or auto: a GPU where there is one.")] = "auto",
    threads: Annotated[int, typer.Option(min=1, help="CPU threads.")] = 1,
    validate_every: Annotated[
        float, typer.Option(min=0.0, max=1.0, help="Share of the run after which to validate; 0: every epoch.")
    ] = 0.0,
    resume: Annotated[bool, typer.Option(help="Go on from OUT/last.pt.")] = False,
) -> None:
    """Train the trunk and post detector, keep the best weights, export them for the robot and print their scores."""
    from navcore.errors import RowpilotError
    from navcore.training.architecture_choice import named_architecture
    from navcore.training.ask_rule import TRAINED
    from navcore.training.samples import read_samples
    from navcore.training.trainer import Trainer, TrainerParams

    try:
        start = _start(begin, net)
        params = TrainerParams(
            epochs=epochs, minutes=minutes, batch=batch, seed=seed, device=device, threads=threads,
            learning_rate=rate, validate_every=validate_every, augment=_cropped(crop),
            architecture=start.architecture if start else named_architecture(net or "small"),
        )  # fmt: skip
        training = read_samples(data, TRAINED)
        if head_only or boxes_only:
            return _ship(_head(start, training, out, params, boxes_only), out / "detector.onnx", validation)
        trainer = Trainer(out, training, read_samples(validation), params)
        if start:
            trainer.begin(start)
        if resume:
            trainer.resume()
        best = trainer.run(typer.echo)
        _ship(best, out / "detector.onnx", validation)
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(1) from error


def _head(
    start: Start | None, training: Sequence[Sample], out: Path, params: TrainerParams, boxes_only: bool
) -> Path:
    """The file of a network whose last layers alone were trained; a batch is of cells there, so it is not asked."""
    from navcore.errors import InputError
    from navcore.training.last_layers.head_training import HeadParams, train_head

    if start is None:
        raise InputError("Only a network that is known already can have its last layers trained; add --from WEIGHTS.")
    rate = params.learning_rate or HeadParams().rate
    own = HeadParams(
        boxes_only=boxes_only, epochs=params.epochs, rate=rate, seed=params.seed, threads=params.threads
    )  # fmt: skip
    return train_head(start, training, out, own, typer.echo)


def _start(weights: Path | None, net: str | None) -> Start | None:
    from navcore.training.architecture_choice import named_architecture
    from navcore.training.start import start_from

    return start_from(weights, named_architecture(net) if net else None) if weights else None


def _cropped(size: tuple[int, int]) -> AugmentParams:
    from navcore.errors import InputError
    from navcore.training.augment import AugmentParams

    if any(side < 64 or side % 32 for side in size):
        raise InputError("A crop's width and height are multiples of 32 px, 64 or more.")
    return AugmentParams(width_px=size[0], height_px=size[1])


def _ship(best: Path, path: Path, validation: Path) -> None:
    """Export, compare with torch, and score what the robot would run."""
    from navcore.cli.score import score_table
    from navcore.training.architecture_choice import load_trained

    architecture, trained = load_trained(best)
    difference = architecture.export(trained, path)
    typer.echo(f"{path}: {path.stat().st_size / 1e6:.2f} MB, differs from torch by at most {difference:.1e}")
    typer.echo(score_table(path, validation))
