"""One page of figures: tables beside the papers', and plots. For a browser, or as Markdown."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from importlib import resources

from jinja2 import Environment, StrictUndefined

from navcore.bench.figure_file import FigureFile, MadeFigure
from navcore.bench.figure_plot import Plot, plot

NO_TABLE = "Not reported in the papers"


@dataclass(frozen=True, slots=True)
class Section:
    """A table of the papers with what stands beside it, or what they do not report."""

    title: str
    figures: tuple[MadeFigure, ...]
    plots: tuple[Plot, ...]

    def has(self, column: str) -> bool:
        """Whether any of its figures has something in that column."""
        return any(getattr(figure, column) is not None for figure in self.figures)


def html_report(files: Iterable[FigureFile]) -> str:
    """A page that needs nothing but itself."""
    return _rendered("report.html.j2", files, escaped=True)


def markdown_report(files: Iterable[FigureFile]) -> str:
    """The tables alone."""
    return _rendered("report.md.j2", files, escaped=False)


def sections(file: FigureFile) -> tuple[Section, ...]:
    """By table, those of the papers first and in their order."""
    by_table: dict[str, list[MadeFigure]] = {}
    for figure in file.figures:
        by_table.setdefault(figure.table or NO_TABLE, []).append(figure)
    titles = sorted(by_table, key=_order)
    return tuple(Section(title, tuple(by_table[title]), _plots(by_table[title])) for title in titles)


def value(number: float | None, unit: str) -> str:
    """As it is printed in a table: shares as per cent."""
    if number is None:
        return "-"
    return f"{100 * number:.1f} %" if unit == "share" else f"{number:.3g} {unit}".removesuffix(" 1")


def verdict(figure: MadeFigure) -> str:
    """In words, empty where nothing is wanted."""
    return "" if figure.ok is None else "met" if figure.ok else "missed"


def _order(title: str) -> tuple[bool, bool, str, int]:
    """By paper, and Table 10 after Table 9; then our own tables."""
    name, _, number = title.partition(":")[0].rpartition(" ")
    return (title == NO_TABLE, not number.isdigit(), name, int(number) if number.isdigit() else 0)


def _plots(figures: list[MadeFigure]) -> tuple[Plot, ...]:
    """One for each unit: metres and per cent do not share an axis."""
    units = dict.fromkeys(figure.unit for figure in figures)
    drawn = (plot([figure for figure in figures if figure.unit == unit]) for unit in units)
    return tuple(one for one in drawn if one is not None)


def _rendered(template: str, files: Iterable[FigureFile], *, escaped: bool) -> str:
    page = resources.files("navcore.bench").joinpath(template).read_text(encoding="utf-8")
    environment = Environment(autoescape=escaped, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    environment.filters.update(value=value, verdict=verdict)
    return environment.from_string(page).render(files=[(file, sections(file)) for file in files])
