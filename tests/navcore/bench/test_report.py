"""One page of figures: complete, in the papers' order, and nothing in it that nobody measured."""

from __future__ import annotations

import json
from dataclasses import asdict
from html.parser import HTMLParser
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from typer.testing import CliRunner

from navcore.bench.figure import Figure, share
from navcore.bench.figure_file import FigureFile, MadeFigure, read_figures
from navcore.bench.figure_plot import AXIS_PX, LABEL_PX, plot
from navcore.bench.report import html_report, markdown_report, sections
from navcore.cli import app
from navcore.errors import InputError

FIGURES = (
    share("centre lines", 99, 100, seed=1, paper=0.93, at_least=0.95, table="Paper A, Table 11: centre lines"),
    share("rows <b>", 80, 100, seed=1, paper=0.9, baseline=0.85, at_least=0.95, table="Paper A, Table 8: rows"),
    share("without it", 70, 100, seed=1, baseline=0.8, table="Ablations: baseline is ours, whole"),
    Figure(figure="error", value=0.3, unit="m", n=4, seed=None, target=0.5, ok=True),
    Figure(figure="never met", value=None, unit="m", n=0, seed=None, target=0.5),
)


def written(folder: Path, rows: object) -> Path:
    path = folder / "rows.json"
    path.write_text(json.dumps(rows))
    return path


def rows() -> list[dict[str, object]]:
    return [{**asdict(figure), "commit": "abc", "machine": "a bench"} for figure in FIGURES]


@pytest.fixture
def file(tmp_path: Path) -> FigureFile:
    return read_figures(written(tmp_path, rows()))


class Cells(HTMLParser):
    """The table cells of a page."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.texts: list[str] = []
        self._inside = False
        self.feed(page)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag == "td":
            self.texts.append("")
            self._inside = True

    def handle_endtag(self, tag: str) -> None:
        self._inside = self._inside and tag != "td"

    def handle_data(self, data: str) -> None:
        if self._inside:
            self.texts[-1] += data


def test_what_a_bench_prints_is_read_again(file: FigureFile) -> None:
    assert [figure.figure for figure in file.figures] == [figure.figure for figure in FIGURES]
    assert (file.name, file.commit, file.machine) == ("rows", "abc", "a bench")


def test_tables_come_in_the_papers_order_and_what_they_do_not_report_last(file: FigureFile) -> None:
    titles = [section.title for section in sections(file)]
    assert titles == [
        "Paper A, Table 8: rows", "Paper A, Table 11: centre lines", "Ablations: baseline is ours, whole",
        "Not reported in the papers",
    ]  # fmt: skip


def test_the_page_shows_each_figure_with_all_that_it_stands_beside(file: FigureFile) -> None:
    cells = Cells(html_report([file])).texts
    at = cells.index("rows <b>")
    assert cells[at : at + 8] == [
        "rows <b>",
        "100",
        "80.0 %",
        "71.1 % to 86.7 %",
        "90.0 %",
        "85.0 %",
        "95.0 %",
        "missed",
    ]
    assert cells[cells.index("never met") + 2] == "-"


def test_a_page_needs_nothing_from_anywhere(file: FigureFile) -> None:
    page = html_report([file])
    assert "http" not in page
    assert "<script" not in page


def test_markdown_holds_one_line_a_figure(file: FigureFile) -> None:
    lines = markdown_report([file]).splitlines()
    assert [line.split(" | ")[0] for line in lines if line.startswith("| ") and "interval" not in line] == [
        "| rows <b>", "| centre lines", "| without it", "| error", "| never met",
    ]  # fmt: skip


@example([0.0, 5e-324], None, "m")
@given(
    st.lists(st.floats(-5.0, 1e6), min_size=1, max_size=5),
    st.none() | st.floats(0.0, 1e4),
    st.sampled_from(["m", "deg"]),
)
def test_every_mark_lies_on_the_axis_and_the_axis_has_few_steps(
    values: list[float], target: float | None, unit: str
) -> None:
    made = [
        MadeFigure(figure="f", value=v, unit=unit, n=1, seed=1, target=target, commit="c", machine="m")
        for v in values
    ]
    drawn = plot(made)
    if drawn is None:
        assert len(values) == 1
        return
    marks = [mark.value for mark in drawn.marks] + [mark.target for mark in drawn.marks if mark.target is not None]
    assert all(LABEL_PX - 0.01 <= x <= LABEL_PX + AXIS_PX + 0.01 for x in marks)
    assert 2 <= len(drawn.ticks) <= 9


@pytest.mark.parametrize(
    "content", ["", "[]", "{}", "[{}]", "[1]", '[{"figure": "f", "value": NaN}]', "\x00\x01", "[[[[[["]
)
def test_what_is_no_list_of_figures_is_refused_in_words(tmp_path: Path, content: str) -> None:
    path = tmp_path / "bad.json"
    path.write_text(content)
    with pytest.raises(InputError, match=r"bad\.json"):
        read_figures(path)


def test_a_missing_number_is_refused(tmp_path: Path) -> None:
    broken = rows()
    del broken[0]["n"]
    with pytest.raises(InputError, match="n"):
        read_figures(written(tmp_path, broken))


def test_the_verb_writes_the_page(tmp_path: Path) -> None:
    out = tmp_path / "report.html"
    result = CliRunner().invoke(app, ["report", str(written(tmp_path, rows())), "--out", str(out)])
    assert result.exit_code == 0, result.output
    assert "Paper A, Table 8" in out.read_text()


@pytest.mark.parametrize("out", ["report.pdf", "nowhere/report.html"])
def test_a_page_that_cannot_be_written_is_an_error_in_words(tmp_path: Path, out: str) -> None:
    result = CliRunner().invoke(app, ["report", str(written(tmp_path, rows())), "--out", str(tmp_path / out)])
    assert result.exit_code == 2
    assert out.split("/")[-1] in result.output
    assert not list(tmp_path.glob("report*"))
