"""`rowpilot export`: a detector's weights as the ONNX file that the robot runs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

BAD_INPUT = 2


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("export")(export)


def export(
    source: Annotated[Path, typer.Argument(help="best.pt of `rowpilot train`, or with --int8 an ONNX file too.")],
    out: Annotated[Path, typer.Option("--out", "-o", help="The ONNX file to write.")] = Path("detector.onnx"),
    int8: Annotated[
        Path | None,
        typer.Option(metavar="FOLDER", help="In 8 bits, their ranges from these labelled pictures; both are scored."),
    ] = None,
) -> None:
    """Write the ONNX file and compare it: in single precision with torch, in 8 bits by both files' scores."""
    from navcore.errors import RowpilotError

    try:
        plain = source if source.suffix == ".onnx" else _single_precision(source, out)
        _eight_bits(plain, out, int8)
    except RowpilotError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None


def _single_precision(source: Path, out: Path) -> Path:
    from navcore.training.architecture_choice import load_trained

    architecture, net = load_trained(source)
    difference = architecture.export(net, out)
    typer.echo(f"{out}: {_size(out)}, differs from torch by at most {difference:.1e}")
    return out


def _eight_bits(plain: Path, out: Path, folder: Path | None) -> None:
    """Nothing is written unless all went well: a half-written detector is none."""
    from navcore.cli.score import score_table
    from navcore.errors import InputError
    from navcore.training.quantize import quantize
    from navcore.training.samples import read_samples

    if folder is None and plain != out:
        raise InputError(f"{plain} is an ONNX file already; with --int8 FOLDER it is written in 8 bits.")
    if folder is None:
        return
    part = out.with_name(f"{out.stem}.part.onnx")
    try:
        quantize(plain, part, read_samples(folder))
        typer.echo(f"in single precision, {_size(plain)}:\n{score_table(plain, folder)}")
        typer.echo(f"in 8 bits, {_size(part)}:\n{score_table(part, folder)}")
        part.replace(out)
    finally:
        part.unlink(missing_ok=True)


def _size(path: Path) -> str:
    return f"{path.stat().st_size / 1e6:.2f} MB"
