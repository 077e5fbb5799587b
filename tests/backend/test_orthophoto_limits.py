"""A picture is refused for its size from its header alone, by each limit for itself."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import pytest
from rasterio.io import DatasetReader

from backend.orthophoto_check import CheckParams, check_size
from navcore.errors import OrthophotoError

GIGABYTE = 2**30


def picture(width: int, height: int) -> DatasetReader:
    """Header of a colour picture."""
    return cast(DatasetReader, SimpleNamespace(width=width, height=height, dtypes=("uint8",) * 3))


@pytest.mark.parametrize(
    ("width", "height", "file_bytes", "sentence"),
    [
        (100_000, 100_000, 10 * GIGABYTE, "Decoded, this picture has 27.9 GB"),
        (60_000, 60_000, 30_000, "unpacks to 10.1 GB is no orthophoto"),
        (10_000, 10_000, 5_000, "A file of 5 kB that unpacks to 0.3 GB"),
        (500_001, 10, GIGABYTE, "cannot be a site's ground"),
        (1, 1000, 5_000, "cannot be a site's ground"),
    ],
)
def test_a_picture_that_is_too_large_in_any_way_is_refused(
    width: int, height: int, file_bytes: int, sentence: str
) -> None:
    with pytest.raises(OrthophotoError, match=sentence):
        check_size(picture(width, height), file_bytes, CheckParams())


@pytest.mark.parametrize(
    ("width", "height", "file_bytes"),
    [(60_000, 60_000, GIGABYTE), (4_000, 4_000, 5_000), (12_000, 12_000, 2_000_000)],
)
def test_a_large_picture_in_a_file_of_its_size_is_not(width: int, height: int, file_bytes: int) -> None:
    check_size(picture(width, height), file_bytes, CheckParams())
