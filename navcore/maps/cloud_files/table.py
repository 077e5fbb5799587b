"""Rows of numbers in a file's body, as text or as bytes, of a length that its header claims."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from navcore.errors import CloudError

Table = NDArray[Any]


def binary_table(body: bytes, dtype: np.dtype[Any], rows: int, source: str) -> Table:
    """The first `rows` rows of `body`, shape (rows,), structured. Raises CloudError if it is cut off."""
    if len(body) < rows * dtype.itemsize:
        whole = len(body) // dtype.itemsize
        raise CloudError(f"{source} ends after point {whole} of {rows} (cut off?); copy or record it again.")
    return np.frombuffer(body, dtype=dtype, count=rows)


def ascii_table(body: bytes, columns: int, rows: int, source: str) -> NDArray[np.float64]:
    """Numbers (rows, columns) of the first `rows` lines. Raises CloudError that names the first wrong line."""
    if columns * rows > len(body):  # a number and what follows it take two bytes, the last one
        raise CloudError(_cut_off(body, rows, source))
    lines = [line for line in body.splitlines() if line.strip()][:rows]
    if len(lines) < rows:
        raise CloudError(_cut_off(body, rows, source))
    try:
        numbers = np.array(b" ".join(lines).split(), dtype=np.float64)
    except ValueError:
        numbers = np.empty(0)
    if len(numbers) != rows * columns or any(len(line.split()) != columns for line in lines):
        raise CloudError(_wrong_line(lines, columns, source))
    return numbers.reshape(rows, columns)


def _cut_off(body: bytes, rows: int, source: str) -> str:
    lines = sum(1 for line in body.splitlines() if line.strip())
    return f"{source} ends after point {min(lines, rows)} of {rows} (cut off?); copy or record it again."


def _wrong_line(lines: list[bytes], columns: int, source: str) -> str:
    for number, line in enumerate(lines, start=1):
        words = line.split()
        if len(words) != columns or not all(map(_is_number, words)):
            text = line[:60].decode("ascii", "replace").strip()
            return f'{source}: point {number} is "{text}", not {columns} numbers; export the file again.'
    return f"{source} holds something else than {columns} numbers a point; export the file again."


def _is_number(word: bytes) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
