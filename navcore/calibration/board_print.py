"""A calibration board as SVG to print at its true size."""

from __future__ import annotations

from collections.abc import Iterator

from navcore.calibration.board import TEXELS, Board, Image

EDGE_MM = 10.0  # white around the pattern, besides one square
RULER_MM = 100.0
FOOT_MM = 18.0


def board_svg(board: Board) -> str:
    """SVG in mm: the pattern, a white edge one square wide and more, and a line of 100 mm to check the printer by."""
    square_mm = 1000.0 * board.square
    wide_mm, high_mm = (1000.0 * side for side in board.pattern)
    edge_mm = square_mm + EDGE_MM
    page = (max(wide_mm, RULER_MM) + 2 * edge_mm, high_mm + 2 * edge_mm + FOOT_MM)
    size = f"{page[0]:g}mm"
    path = "".join(_dark(board, square_mm / TEXELS, (page[0] - wide_mm) / 2, edge_mm))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{page[1]:g}mm" '
        f'viewBox="0 0 {page[0]:g} {page[1]:g}"><rect width="100%" height="100%" fill="#fff"/>'
        f'<path d="{path}" fill="#000" shape-rendering="crispEdges"/>'
        f"{_foot(board, page, high_mm + 2 * edge_mm)}</svg>"
    )


def _dark(board: Board, texel_mm: float, x0: float, y0: float) -> Iterator[str]:
    """A rectangle for each dark stretch of a row; rows that are alike are one, so that no seam is seen."""
    texture = board.texture()
    rows = texture.shape[0]
    first = 0
    while first < rows:
        last = first
        while last + 1 < rows and (texture[last + 1] == texture[first]).all():
            last += 1
        for left, right in _stretches(texture, first):
            x, y = x0 + left * texel_mm, y0 + first * texel_mm
            wide, high = (right - left) * texel_mm, (last + 1 - first) * texel_mm
            yield f"M{x:.3f} {y:.3f}h{wide:.3f}v{high:.3f}h{-wide:.3f}z"
        first = last + 1


def _stretches(texture: Image, row: int) -> Iterator[tuple[int, int]]:
    left = None
    for column, dark in enumerate([*(texture[row] < 128), False]):
        if dark and left is None:
            left = column
        elif not dark and left is not None:
            yield left, column
            left = None


def _foot(board: Board, page: tuple[float, float], y: float) -> str:
    """What to do, and the line to measure."""
    kind = "ChArUco board" if board.charuco else "Board"
    words = (
        f"{kind}, {board.columns} x {board.rows} inner corners, squares of {1000 * board.square:g} mm. "
        f"Print at 100 %: this line is {RULER_MM:g} mm."
    )
    x = (page[0] - RULER_MM) / 2
    return (
        f'<path d="M{x:g} {y:g}h{RULER_MM:g}m0 -2v4m{-RULER_MM:g} -4v4" stroke="#000" stroke-width="0.4" '
        f'fill="none"/>'
        f'<text x="{page[0] / 2:g}" y="{y + 7:g}" font-size="3.6" font-family="sans-serif" '
        f'text-anchor="middle">{words}</text>'
    )
