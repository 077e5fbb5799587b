"""Figures as `rowpilot bench NAME --json` prints them, read again."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import msgspec

from navcore.bench.figure import Figure
from navcore.errors import InputError

# No bench prints more; what is larger is something else.
MOST_BYTES = 10_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class MadeFigure(Figure):
    """A figure with the commit and the machine that gave it."""

    commit: str
    machine: str


@dataclass(frozen=True, slots=True)
class FigureFile:
    """The figures of one run of a bench; `name` is the file's, without its ending."""

    name: str
    figures: tuple[MadeFigure, ...]

    @property
    def commit(self) -> str:
        """Of the program that was measured."""
        return self.figures[0].commit

    @property
    def machine(self) -> str:
        """On which it was measured."""
        return self.figures[0].machine


def read_figures(path: Path) -> FigureFile:
    """Raises InputError, in words, for what is no list of figures."""
    try:
        if path.stat().st_size > MOST_BYTES:
            raise InputError(f"{path} is too large to be the figures of a bench.")
        figures = msgspec.json.decode(path.read_bytes(), type=tuple[MadeFigure, ...])
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}.") from error
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path} is not what `rowpilot bench NAME --json` prints: {error}.") from error
    if not figures:
        raise InputError(f"{path} holds no figures.")
    return FigureFile(path.stem, figures)
