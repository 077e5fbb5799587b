"""`rowpilot replay LOG`: does the navigator decide the same again?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from navcore.errors import InputError


def register(app: typer.Typer) -> None:
    """Add the verb."""
    app.command(name="replay")(replay)


def replay(
    log: Annotated[Path, typer.Argument(help="Run log, MCAP.")],
    config: Annotated[
        Path | None, typer.Option(help="Other settings, TOML: where would they decide otherwise?")
    ] = None,
) -> None:
    """Feed a run's recorded inputs through the navigator and report the first decision that differs."""
    from navcore.config import load_config
    from navcore.runtime.replay_log import replay_log

    try:
        result = replay_log(log, load_config(config) if config else None)
    except InputError as error:
        typer.echo(f"rowpilot: {error}", err=True)
        raise typer.Exit(2) from error
    if result.difference is None:
        typer.echo(f"{result.ticks} decisions, all the same.")
        return
    d = result.difference
    typer.echo(f"Decision {d.tick} at {d.stamp_ns} ns differs.\nrecorded: {d.recorded.decode()}")
    typer.echo(f"replayed: {d.replayed.decode()}")
    raise typer.Exit(1)
