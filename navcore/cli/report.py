"""`rowpilot report`: figures of benches as one page."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

BAD_INPUT = 2


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command("report")(report)


def report(
    files: Annotated[
        list[Path], typer.Argument(metavar="FILE...", help="What `rowpilot bench NAME --json` printed.")
    ],
    out: Annotated[
        Path, typer.Option("--out", "-o", help="Written here: .html with plots, or .md with tables alone.")
    ] = Path("report.html"),
) -> None:
    """Tables beside the papers' and plots, in one page that needs nothing but itself."""
    from navcore.bench.figure_file import read_figures
    from navcore.bench.report import html_report, markdown_report
    from navcore.errors import InputError

    makers = {".html": html_report, ".md": markdown_report}
    try:
        if out.suffix not in makers:
            raise InputError(f"{out} must end in .html or .md.")
        page = makers[out.suffix]([read_figures(path) for path in files])
        _write(out, page)
    except InputError as error:
        typer.echo(str(error), err=True)
        raise typer.Exit(BAD_INPUT) from None
    typer.echo(f"Written to {out}.")


def _write(out: Path, page: str) -> None:
    from navcore.errors import InputError

    try:
        out.write_text(page, encoding="utf-8")
    except OSError as error:
        raise InputError(f"{out} cannot be written: {error.strerror}.") from error
